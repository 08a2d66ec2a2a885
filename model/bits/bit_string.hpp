// Bit strings and masks: reading and writing fields (CNV-4), population counts (CNV-6).
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hmlfc {
/// Whether bit i in [0, 63] of `mask` is 1.
constexpr bool has_bit(uint64_t mask, unsigned i) { return ((mask >> i) & 1u) != 0; }

/// Number of 1 bits of `mask` below bit i in [0, 63].
///
/// Example: rank(0b1011, 2) = 2.
constexpr unsigned rank(uint64_t mask, unsigned i) {
  return static_cast<unsigned>(std::popcount(mask & ((uint64_t{1} << i) - 1)));
}

/// A read-only bit string over bytes: bit k is bit (k & 7) of byte k >> 3.
class BitString {
 public:
  BitString() = default;
  explicit BitString(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  /// Length in bits.
  uint64_t size() const { return static_cast<uint64_t>(bytes_.size()) * 8; }

  /// Whether the string holds bits [position, position + count).
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

/// Appends fields to a growing bit string; the bits of the last byte not yet written are 0.
class BitWriter {
 public:
  /// Appends the low `count` bits of `value`; count in [0, 32], value in [0, 2^count - 1].
  void put(uint32_t value, unsigned count) {
    assert(count <= 32 && (count == 32 || (value >> count) == 0));
    uint64_t pending = value;
    unsigned left = count;
    while (left > 0) {
      const unsigned used = static_cast<unsigned>(size_ & 7);
      if (used == 0) bytes_.push_back(0);
      const unsigned taken = left < 8 - used ? left : 8 - used;
      const uint64_t low = pending & ((1u << taken) - 1u);
      bytes_.back() = static_cast<uint8_t>(bytes_.back() | (low << used));
      pending >>= taken;
      left -= taken;
      size_ += taken;
    }
  }

  /// Appends `value` in two's complement; it must lie in [-2^(count - 1), 2^(count - 1) - 1], and
  /// be 0 where count is 0.
  void put_signed(int32_t value, unsigned count) {
    const uint32_t mask = count >= 32 ? ~0u : (1u << count) - 1u;
    put(static_cast<uint32_t>(value) & mask, count);
  }

  /// Bits written so far.
  uint64_t size() const { return size_; }

  const std::vector<uint8_t>& bytes() const { return bytes_; }

  /// The bytes written; the writer is empty afterwards.
  std::vector<uint8_t> take() {
    size_ = 0;
    return std::exchange(bytes_, {});
  }

 private:
  std::vector<uint8_t> bytes_;
  uint64_t size_ = 0;
};

}  // namespace hmlfc
