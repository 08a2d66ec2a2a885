// What of a stream frames of some views need.
#pragma once

#include <array>
#include <set>
#include <tuple>
#include <vector>

#include <hmlfc/byte_source.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// An image of the tree.
struct TreeImage {
  int level = 0;
  ImagePos at;

  friend bool operator<(const TreeImage& a, const TreeImage& b) {
    return std::tie(a.level, a.at.row, a.at.col) < std::tie(b.level, b.at.row, b.at.col);
  }
};

/// All that decodes the views, down to a level, and their disparities.
struct FrameNeeds {
  std::set<TreeImage> keys;        ///< key images
  std::set<TreeImage> references;  ///< other reference images, in the reference area
  std::vector<ByteRange> ranges;   ///< of the file, of TOP aside; records end where the next begin
};

/// The needs of views [rows[0], rows[1]] x [cols[0], cols[1]], which exist. Errors: bus_error where
/// records of the index are not loaded.
Result<FrameNeeds> frame_needs(const StreamView& stream, std::array<uint32_t, 2> rows,
                               std::array<uint32_t, 2> cols, int stop_level);

}  // namespace hmlfc::gpu
