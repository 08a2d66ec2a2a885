// A bit string spelled out, one bool a bit: what tests write by hand and compare with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hmlfc::test {

/// A growing bit string by the words of CNV-4 and nothing else.
class NaiveBits {
 public:
  NaiveBits() = default;

  /// The bits of whole bytes.
  explicit NaiveBits(std::span<const uint8_t> bytes) {
    for (size_t k = 0; k < bytes.size() * 8; ++k) bits_.push_back((bytes[k / 8] >> (k % 8)) % 2);
  }

  /// Appends a field: bit i of the value at position p + i. count in [0, 64].
  NaiveBits& put(uint64_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i) bits_.push_back((value >> i) % 2 != 0);
    return *this;
  }

  /// Appends a signed field in two's complement (CNV-5).
  NaiveBits& put_signed(int64_t value, unsigned count) {
    return put(static_cast<uint64_t>(value), count);
  }

  /// Appends all bits of `other`.
  NaiveBits& put(const NaiveBits& other) {
    bits_.insert(bits_.end(), other.bits_.begin(), other.bits_.end());
    return *this;
  }

  size_t size() const { return bits_.size(); }
  bool operator[](size_t k) const { return bits_[k]; }

  /// The field of `count` in [0, 64] bits at `position`; bits past the end read as 0.
  uint64_t field(size_t position, unsigned count) const {
    uint64_t value = 0;
    for (unsigned i = 0; i < count; ++i) {
      if (position + i < bits_.size() && bits_[position + i]) value |= uint64_t{1} << i;
    }
    return value;
  }

  /// The bytes, the last one filled up with 0 bits.
  std::vector<uint8_t> bytes() const {
    std::vector<uint8_t> bytes((bits_.size() + 7) / 8);
    for (size_t k = 0; k < bits_.size(); ++k) {
      if (bits_[k]) bytes[k / 8] = static_cast<uint8_t>(bytes[k / 8] + (1 << (k % 8)));
    }
    return bytes;
  }

 private:
  std::vector<bool> bits_;
};

}  // namespace hmlfc::test
