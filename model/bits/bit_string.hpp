// Reading fields from a bit string (CNV-4).
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hmlfc {

/// A read-only bit string over bytes: bit k is bit (k & 7) of byte k >> 3.
class BitString {
 public:
  BitString() = default;
  explicit BitString(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  /// Length in bits.
  uint64_t size() const { return static_cast<uint64_t>(bytes_.size()) * 8; }

  /// Whether bits [position, position + count) are all there.
  bool holds(uint64_t position, uint64_t count) const {
    return position <= size() && count <= size() - position;
  }

  /// The field of `count` bits in [0, 32] at `position`; holds(position, count) must be true.
  ///
  /// Example: bytes {0xB4, 0x01}, field(2, 7) = 0b1101101 = 109.
  uint32_t field(uint64_t position, unsigned count) const {
    assert(count <= 32 && holds(position, count));
    if (count == 0) return 0;
    const auto first = static_cast<size_t>(position >> 3);
    const auto last = static_cast<size_t>((position + count - 1) >> 3);
    uint64_t bytes = 0;
    for (size_t at = first; at <= last; ++at) bytes |= uint64_t{bytes_[at]} << (8 * (at - first));
    return static_cast<uint32_t>((bytes >> (position & 7)) & ((uint64_t{1} << count) - 1));
  }

  std::span<const uint8_t> bytes() const { return bytes_; }

 private:
  std::span<const uint8_t> bytes_;
};

}  // namespace hmlfc
