// Little-endian integers in byte arrays (CNV-3).
#pragma once

#include <bit>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace hmlfc {

/// Whether the bytes in memory have this order. Nothing else asks for the processor's.
inline constexpr bool kLittleEndian = std::endian::native == std::endian::little;

/// The unsigned integer at bytes[offset, offset + sizeof(T)), which must be there.
template <std::unsigned_integral T>
T load_le(std::span<const uint8_t> bytes, size_t offset) {
  assert(offset <= bytes.size() && sizeof(T) <= bytes.size() - offset);
  T value = 0;
  if constexpr (kLittleEndian) std::memcpy(&value, &bytes[offset], sizeof(T));
  for (size_t i = sizeof(T); !kLittleEndian && i-- > 0;) {
    value = static_cast<T>(value << 8 | bytes[offset + i]);
  }
  return value;
}

/// Appends `value` to `bytes`.
template <std::unsigned_integral T>
void append_le(std::vector<uint8_t>& bytes, T value) {
  for (size_t i = 0; i < sizeof(T); ++i) {
    bytes.push_back(static_cast<uint8_t>((value >> (8 * i)) & 0xFF));
  }
}

}  // namespace hmlfc
