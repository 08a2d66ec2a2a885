// The values of one block while it is decoded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hmlfc {

inline constexpr unsigned kMaxBlockSize = 8;

/// B x B values, row by row, B in {2, 4, 8}.
class BlockValues {
 public:
  explicit BlockValues(unsigned block_size) : block_size_(block_size) {}

  unsigned block_size() const { return block_size_; }
  size_t size() const { return size_t{block_size_} * block_size_; }

  int32_t& at(unsigned x, unsigned y) { return values_[y * block_size_ + x]; }
  int32_t at(unsigned x, unsigned y) const { return values_[y * block_size_ + x]; }
  int32_t& operator[](size_t i) { return values_[i]; }
  int32_t operator[](size_t i) const { return values_[i]; }

  std::span<const int32_t> span() const { return {values_.data(), size()}; }

 private:
  unsigned block_size_;
  std::array<int32_t, size_t{kMaxBlockSize} * kMaxBlockSize> values_{};
};

}  // namespace hmlfc
