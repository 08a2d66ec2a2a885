#include "geometry_extremes.hpp"

#include "syntax/geometry.hpp"

namespace hmlfc::stress {
namespace {

StreamHeader largest_header() {
  StreamHeader header;
  header.profile = Profile::kExtended;
  header.feature_flags = feature_bit(Feature::kMotionTiles) | feature_bit(Feature::kChromaMotion);
  header.rows = 4096;
  header.cols = 4096;
  header.width = 65536;
  header.height = 65536;
  header.chroma_format = ChromaFormat::k444;
  header.block_log2 = 1;
  header.motion_tile_log2 = 5;
  header.cluster_rows = 1;
  header.cluster_cols = 2;
  header.tree_height = 15;
  header.levels.assign(16, LevelEntry{255, 255, 0});
  return header;
}

}  // namespace

Ranges geometry_extremes() {
  static_cast<void>(take_ranges());
  const StreamHeader header = largest_header();
  const Geometry geometry(header);
  const auto last = [](uint32_t count) { return count - 1; };
  static_cast<void>(
      geometry.tile_number(geometry.image_number(header.tree_height, {0, 0}), Plane::kY, 0, 0));
  const uint64_t image = geometry.image_number(0, {last(header.rows), last(header.cols)});
  const size_t motion = geometry.motion_planes().size() - 1;
  const MotionPlaneShape& plane = geometry.motion_planes()[motion];
  static_cast<void>(
      geometry.motion_tile_number(image, motion, last(plane.tiles_x), last(plane.tiles_y)));
  return take_ranges();
}

}  // namespace hmlfc::stress
