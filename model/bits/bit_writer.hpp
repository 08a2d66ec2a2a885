// Writing fields to a bit string (CNV-4).
#pragma once

#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

namespace hmlfc {

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
