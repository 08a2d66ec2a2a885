// Whether a frame request fits a light field, and which views show the same image.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>

namespace hmlfc {

inline constexpr int32_t kMaxRecordPitch = 127 * 16;  ///< of FrameRecord::pitch (CAM-3)

/// Whether `record` and `stop_level` belong to a light field of this header.
inline bool fits(const FrameRecord& record, const StreamHeader& header, int stop_level) {
  const auto is_side = [](int32_t pixels) { return pixels >= 1 && pixels <= kMaxFrameSide; };
  return is_side(record.frame_width) && is_side(record.frame_height) && record.filter >= 0 &&
         record.filter <= 2 && record.aperture >= 0 && record.aperture <= kMaxAperture &&
         record.geometry >= 0 && record.geometry <= (record.aperture == 0 ? 1 : 0) &&
         std::abs(record.focus) <= 1 << 16 && std::abs(record.pitch) <= kMaxRecordPitch &&
         record.fine >= 0 && record.fine <= 1 << 8 && stop_level >= 0 &&
         stop_level <= header.tree_height && record.cols == static_cast<int32_t>(header.cols) &&
         record.rows == static_cast<int32_t>(header.rows) &&
         record.width == static_cast<int32_t>(header.width) &&
         record.height == static_cast<int32_t>(header.height);
}

/// The first view, row by row, that shows the ancestor of `view` at level `stop_level` (DEC-1,
/// NED-1).
inline ViewPos first_view_of(const StreamHeader& header, ViewPos view, int stop_level) {
  uint64_t rows = 1;
  uint64_t cols = 1;
  for (int level = 0; level < stop_level; ++level) {
    rows = std::min<uint64_t>(rows * header.cluster_rows, header.rows);
    cols = std::min<uint64_t>(cols * header.cluster_cols, header.cols);
  }
  return {static_cast<uint32_t>(view.row / rows * rows),
          static_cast<uint32_t>(view.col / cols * cols)};
}

}  // namespace hmlfc
