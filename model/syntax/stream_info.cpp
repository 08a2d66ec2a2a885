#include <hmlfc/stream_info.hpp>

#include <algorithm>

#include "syntax/geometry.hpp"

namespace hmlfc {

std::string_view method_name(const StreamHeader& header) {
  const bool motion = std::any_of(header.levels.begin(), header.levels.end(), [](LevelEntry level) {
    return level.ref_rows > 1 || level.ref_cols > 1;
  });
  if (header.tree_height == 0) return motion ? "mc" : "intra";
  return motion ? "hmlfc" : "rlfc";
}

LevelInfo level_info(const StreamHeader& header, int level) {
  const Geometry geometry(header);
  const LevelShape& shape = geometry.level(level);
  const uint64_t keys = shape.keyed ? uint64_t{shape.group_rows()} * shape.group_cols() : 0;
  return {shape.rows, shape.cols, shape.ref_rows, shape.ref_cols, keys};
}

ImageInfo image_info(const StreamHeader& header, int level, uint32_t row, uint32_t col) {
  const Geometry geometry(header);
  const ImagePos reference = geometry.reference_of(level, {row, col});
  const ImageKind kind = reference != ImagePos{row, col}      ? ImageKind::kPredictive
                         : geometry.is_key(level, {row, col}) ? ImageKind::kKey
                                                              : ImageKind::kReference;
  return {kind, reference.row, reference.col};
}

// LVL-1 to LVL-3.
int conformance_level(const StreamHeader& header) {
  const auto keeps = [&](const ConformanceLimits& limits) {
    return std::max(header.rows, header.cols) <= limits.grid_side &&
           std::max(header.width, header.height) <= limits.view_side &&
           uint64_t{header.width} * header.height <= limits.view_pixels &&
           header.depth <= limits.depth && header.window <= limits.window &&
           header.tree_height <= limits.tree_height;
  };
  size_t level = 0;
  while (!keeps(kConformanceLimits[level])) ++level;
  return static_cast<int>(level);
}

}  // namespace hmlfc
