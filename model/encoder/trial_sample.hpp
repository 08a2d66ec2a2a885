// The part of a light field's views that is coded to try parameters.
#pragma once

#include <cstdint>
#include <vector>

#include "syntax/geometry.hpp"

namespace hmlfc {

/// The rows of a plane that are coded: every `step`-th strip of 2^log2 rows, from strip `first` on.
/// Blocks of other rows get no records, and their samples have no meaning.
struct CodedRows {
  uint32_t first = 0;  ///< [0, step - 1]
  uint32_t step = 1;   ///< 1: all rows
  unsigned log2 = 6;   ///< of plane Y: motion_tile_log2, so that strips are rows of motion tiles

  bool has_strip(uint32_t strip) const { return strip % step == first; }
  bool has(uint32_t y) const { return has_strip(y >> log2); }

  /// The same rows in a plane of half the height.
  CodedRows halved() const { return {first, step, log2 - 1}; }
};

/// What a trial codes of level 0: these predictive images, in these rows, and what they refer to.
struct TrialSample {
  CodedRows rows;
  std::vector<ImagePos> images;
};

/// At most `count` > 0 of `images`, evenly spread over their order.
inline std::vector<ImagePos> evenly_spread(const std::vector<ImagePos>& images, size_t count) {
  if (images.size() <= count) return images;
  std::vector<ImagePos> some;
  for (size_t i = 0; i < count; ++i) {
    some.push_back(images[(2 * i + 1) * images.size() / (2 * count)]);
  }
  return some;
}

}  // namespace hmlfc
