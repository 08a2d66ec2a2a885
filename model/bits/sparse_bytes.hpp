// Room for the bytes of a long file of which few are there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/byte_source.hpp>

namespace hmlfc {

/// Address space that takes memory once it is written to.
class Reservation {
 public:
  /// `bytes` zeros; data() is null where there is no room for them.
  explicit Reservation(uint64_t bytes);
  Reservation(const Reservation&) = delete;
  Reservation& operator=(const Reservation&) = delete;
  ~Reservation();

  uint8_t* data() const { return data_; }

  /// Makes `bytes` bytes from `offset` on zeros that take no memory; both are multiples of a page.
  void clear(uint64_t offset, uint64_t bytes);

 private:
  size_t bytes_;
  uint8_t* data_;
};

/// A file of which lines of kLineBytes bytes are loaded one by one and dropped by pages of
/// kPageBytes. Several threads may call holds() at once, also while one thread loads.
class SparseBytes {
 public:
  static constexpr uint64_t kLineBytes = 64;
  static constexpr uint64_t kPageBytes = 4096;

  /// Nothing is loaded. is_reserved() is false where the address space does not suffice.
  explicit SparseBytes(uint64_t size);

  bool is_reserved() const;

  std::span<const uint8_t> bytes() const { return {file_.data(), static_cast<size_t>(size_)}; }

  /// Whether `range` lies in the file. One that does not is never loaded: where a range comes from
  /// the bytes of the file, these may be anything.
  bool contains(ByteRange range) const;

  /// Whether all lines of `range` are loaded; notes that they are used.
  bool holds(ByteRange range) const;

  /// The lines of `ranges` that are not loaded, as ascending and disjoint ranges of whole lines, or
  /// up to the end of the file. Those at most `gap` bytes apart are one, with what lies between;
  /// but none has a line that is loaded: somebody may be reading it, and it may come back changed.
  std::vector<ByteRange> missing(std::span<const ByteRange> ranges, uint64_t gap) const;

  /// Where to write the bytes of `range`; no room where it does not lie in the file.
  std::span<uint8_t> room(ByteRange range);

  /// `range`, one of those that missing() gave, has been written.
  void set_loaded(ByteRange range);

  /// Bytes of the pages with lines that are loaded.
  uint64_t held_bytes() const { return pages_.size() * kPageBytes; }

  /// Drops pages, those used longest ago first, until at most `bytes` are held. Not while another
  /// thread reads.
  void drop_to(uint64_t bytes);

  /// Ranges used from now on count as used later than those used before.
  void tick() { ++now_; }

 private:
  template <class Visit>
  static bool all_words(ByteRange range, const Visit& visit);

  // Whether a line is loaded that begins in [begin, end), whole lines.
  bool holds_any(uint64_t begin, uint64_t end) const;

  uint64_t& lines_of(uint64_t page) const;
  uint32_t& used_of(uint64_t page) const;

  uint64_t size_;
  Reservation file_;
  Reservation lines_;  // a bit a line, a word a page
  Reservation used_;   // the last use of each page, 32 bits
  std::vector<uint64_t> pages_;
  uint32_t now_ = 1;
};

}  // namespace hmlfc
