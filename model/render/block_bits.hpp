// A set of blocks of one plane: one bit a block, rows of whole words.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hmlfc {

/// Blocks of a plane of columns x rows blocks. Bits may be set by several threads at once.
class BlockBits {
 public:
  BlockBits() = default;
  BlockBits(uint32_t columns, uint32_t rows)
      : columns_(columns), row_words_((columns + 63) / 64), words_(size_t{row_words_} * rows) {}

  uint32_t columns() const { return columns_; }

  /// Adds block (bx, by).
  void set(uint32_t bx, uint32_t by) {
    add(size_t{by} * row_words_ + bx / 64, uint64_t{1} << (bx % 64));
  }

  /// Adds to row `by` the blocks of `words`, the first bit of which is block 64 * first_word.
  void set_words(uint32_t by, uint32_t first_word, std::span<const uint64_t> words) {
    for (size_t i = 0; i < words.size(); ++i) {
      add(size_t{by} * row_words_ + first_word + i, words[i]);
    }
  }

  bool has(uint32_t bx, uint32_t by) const {
    return (words_[size_t{by} * row_words_ + bx / 64] >> (bx % 64) & 1) != 0;
  }

  /// Adds blocks [begin, end) of row `by`, at least one.
  void set_range(uint32_t begin, uint32_t end, uint32_t by) {
    for (uint32_t word = begin / 64; word <= (end - 1) / 64; ++word) {
      add(size_t{by} * row_words_ + word, bits_of_range(word, begin, end));
    }
  }

  /// Whether blocks [begin, end) of row `by`, at least one, are all there.
  bool has_range(uint32_t begin, uint32_t end, uint32_t by) const {
    for (uint32_t word = begin / 64; word <= (end - 1) / 64; ++word) {
      if ((bits_of_range(word, begin, end) & ~words_[size_t{by} * row_words_ + word]) != 0) {
        return false;
      }
    }
    return true;
  }

  /// Makes this the set of blocks (bx >> 1, by >> 1) of the blocks of `finer`, which has at most
  /// twice as many columns and rows.
  void set_halves(const BlockBits& finer) {
    clear();
    for (size_t at = 0; at < finer.words_.size(); ++at) {
      if (finer.words_[at] == 0) continue;
      const size_t by = at / finer.row_words_;
      const size_t word = at % finer.row_words_;
      words_[by / 2 * row_words_ + word / 2] |= halves(finer.words_[at]) << (word % 2 * 32);
    }
  }

  /// Removes all blocks.
  void clear() { std::fill(words_.begin(), words_.end(), uint64_t{0}); }

  /// Removes the blocks of rows [first, last).
  void clear_rows(uint32_t first, uint32_t last) {
    const auto begin = words_.begin();
    std::fill(begin + static_cast<ptrdiff_t>(size_t{first} * row_words_),
              begin + static_cast<ptrdiff_t>(size_t{last} * row_words_), uint64_t{0});
  }

  /// Whether there is a block in rows [first, last).
  bool any_in_rows(uint32_t first, uint32_t last) const {
    for (size_t i = size_t{first} * row_words_; i < size_t{last} * row_words_; ++i) {
      if (words_[i] != 0) return true;
    }
    return false;
  }

  /// Whether there is one that is not in `other`, of the same shape.
  bool any_without(const BlockBits& other, uint32_t first, uint32_t last) const {
    for (size_t i = size_t{first} * row_words_; i < size_t{last} * row_words_; ++i) {
      if ((words_[i] & ~other.words_[i]) != 0) return true;
    }
    return false;
  }

  uint64_t count() const {
    uint64_t sum = 0;
    for (const uint64_t word : words_) sum += static_cast<uint64_t>(std::popcount(word));
    return sum;
  }

  /// How many blocks of this set are not in `other`, of the same shape.
  uint64_t count_without(const BlockBits& other) const {
    uint64_t sum = 0;
    for (size_t i = 0; i < words_.size(); ++i) {
      sum += static_cast<uint64_t>(std::popcount(words_[i] & ~other.words_[i]));
    }
    return sum;
  }

  /// Calls visit(bx0, bx1) for each longest run of blocks [bx0, bx1) of row `by` that are in this
  /// set and not in `other`.
  template <class Visit>
  void for_each_run_without(const BlockBits& other, uint32_t by, const Visit& visit) const {
    const size_t row = size_t{by} * row_words_;
    uint32_t begin = columns_;
    for (uint32_t word = 0; word < row_words_; ++word) {
      uint64_t left = words_[row + word] & ~other.words_[row + word];
      // The bits where a run begins or ends.
      uint64_t changes = left ^ (left << 1 | (begin < columns_ ? 1u : 0u));
      for (; changes != 0; changes &= changes - 1) {
        const uint32_t at = word * 64 + static_cast<uint32_t>(std::countr_zero(changes));
        if (begin < columns_) {
          visit(begin, at);
          begin = columns_;
        } else {
          begin = at;
        }
      }
    }
    if (begin < columns_) visit(begin, columns_);
  }

 private:
  // The bits of columns [begin, end) that lie in word `word` of a row, which has some of them.
  static constexpr uint64_t bits_of_range(uint32_t word, uint32_t begin, uint32_t end) {
    uint64_t bits = ~uint64_t{0};
    if (word == begin / 64) bits &= bits << (begin % 64);
    if (word == (end - 1) / 64) bits &= ~uint64_t{0} >> (63 - (end - 1) % 64);
    return bits;
  }

  // Bit k, in [0, 31]: whether bit 2k or 2k + 1 of `bits` is set.
  static constexpr uint64_t halves(uint64_t bits) {
    bits = (bits | bits >> 1) & 0x5555555555555555;
    bits = (bits | bits >> 1) & 0x3333333333333333;
    bits = (bits | bits >> 2) & 0x0F0F0F0F0F0F0F0F;
    bits = (bits | bits >> 4) & 0x00FF00FF00FF00FF;
    bits = (bits | bits >> 8) & 0x0000FFFF0000FFFF;
    return (bits | bits >> 16) & 0x00000000FFFFFFFF;
  }

  void add(size_t at, uint64_t bits) {
    const std::atomic_ref<uint64_t> word(words_[at]);
    if ((bits & ~word.load(std::memory_order_relaxed)) != 0) {
      word.fetch_or(bits, std::memory_order_relaxed);
    }
  }

  uint32_t columns_ = 0;
  uint32_t row_words_ = 0;
  std::vector<uint64_t> words_;
};

}  // namespace hmlfc
