// Places in the 40 bits of a unit's addresses, by seed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stimulus/conditions.hpp"

namespace hmlfc::tb {

/// Addresses [0, 2^40 - 1], of which nothing is taken at first.
class AddressSpace {
 public:
  static constexpr uint64_t kEnd = uint64_t{1} << 40;
  static constexpr uint64_t kApart = 64;  ///< bytes between two places, at least

  /// What a stream's address is a multiple of, and the bytes after it that a unit may read.
  static uint64_t stream_alignment(unsigned beat_bytes) { return std::max(16u, beat_bytes); }
  static uint64_t read_behind(unsigned beat_bytes) { return 15 + beat_bytes; }

  explicit AddressSpace(uint64_t seed) : random_(seed) {}

  /// A place for `bytes`, in [1, 2^32], at a multiple of `alignment`, apart from those taken: in
  /// one of eight cases the lowest, in one the highest that leaves `behind` bytes after it, in one
  /// across or next to a multiple of 4 GiB, else anywhere. Takes it.
  uint64_t take(uint64_t bytes, uint64_t alignment, uint64_t behind);

  /// How many places are taken.
  size_t size() const { return taken_.size(); }

  /// Gives back all places but the `count` that were taken first.
  void resize(size_t count) { taken_.resize(count); }

 private:
  struct Range {
    uint64_t begin = 0;
    uint64_t end = 0;
  };

  uint64_t candidate(uint64_t bytes, uint64_t highest);
  bool is_free(uint64_t begin, uint64_t end) const;

  Random random_;
  std::vector<Range> taken_;
};

}  // namespace hmlfc::tb
