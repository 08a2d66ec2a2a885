#include "stream_shape.hpp"

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "device/machine_error.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kMaxStreamWords = uint64_t{1} << 32;

uint32_t row_words(const PlaneShape& plane) { return ceil_div(plane.width, 2u); }

// Streams beyond the limit are refused (FIL-7).
uint32_t checked_words(uint64_t bytes, const char* what) {
  if (bytes / 4 >= kMaxStreamWords) {
    throw MachineError(FailureKind::kLimit,
                       std::string("limit_exceeded: ") + what + " takes 16 GiB or more");
  }
  return static_cast<uint32_t>(bytes / 4);
}

// What divided() of shaders/integers.glsl takes for `divisor`, at least 1.
uint32_t inverse_of(uint32_t divisor) { return UINT32_MAX / divisor; }

void fill_levels(const Geometry& geometry, bool balanced, StreamShapeRecord& shape) {
  uint32_t references = 0;
  for (int l = 0; l <= geometry.top(); ++l) {
    const LevelShape& level = geometry.level(l);
    shape.levels[static_cast<size_t>(l)] = {level.rows,
                                            level.cols,
                                            level.ref_rows,
                                            level.ref_cols,
                                            level.group_rows(),
                                            level.group_cols(),
                                            static_cast<uint32_t>(level.first_image),
                                            references,
                                            level.keyed ? 1u : 0u,
                                            inverse_of(balanced ? level.rows : level.ref_rows),
                                            inverse_of(balanced ? level.cols : level.ref_cols),
                                            inverse_of(level.group_rows()),
                                            inverse_of(level.group_cols())};
    if (has_references(level)) references += level.group_rows() * level.group_cols();
  }
}

void fill_planes(const StreamView& stream, StreamShapeRecord& shape) {
  const Geometry& geometry = stream.geometry;
  uint32_t first_word = 0;
  for (const Plane p : kPlanes) {
    const PlaneShape& plane = geometry.plane(p);
    const SampleRange range = sample_range(p, stream.header.depth);
    const bool tiled = !geometry.motion_planes().empty();
    const size_t motion_plane = tiled ? geometry.motion_plane_of(p) : 0;
    const bool halved = tiled && p != Plane::kY && geometry.motion_planes()[motion_plane].halves;
    shape.planes[static_cast<size_t>(p)] = {plane.width,
                                            plane.height,
                                            plane.blocks_x,
                                            plane.blocks_y,
                                            plane.tiles_x,
                                            plane.tiles_y,
                                            static_cast<uint32_t>(plane.first_tile),
                                            static_cast<uint32_t>(motion_plane),
                                            halved ? 1u : 0u,
                                            row_words(plane),
                                            first_word,
                                            range.lo,
                                            range.hi,
                                            range.bound};
    first_word += row_words(plane) * plane.height;
  }
  for (size_t m = 0; m < geometry.motion_planes().size(); ++m) {
    const MotionPlaneShape& plane = geometry.motion_planes()[m];
    shape.motion_planes[m] = {plane.width, plane.height, plane.tiles_x, plane.tiles_y,
                              static_cast<uint32_t>(plane.first_tile)};
  }
}

void fill_sections(const StreamView& stream, StreamShapeRecord& shape) {
  const uint64_t root_bytes = stream.entry(Section::kRoot).size;
  const uint64_t group_bytes = stream.entry(Section::kGroup).size;
  const uint64_t tile_bytes = stream.entry(Section::kTile).size;
  checked_words(root_bytes + group_bytes + tile_bytes + 4, "the stream");
  shape.group_word = checked_words(root_bytes, "the stream");
  shape.group_records = static_cast<uint32_t>(group_bytes / 16);
  shape.tile_word = checked_words(root_bytes + group_bytes, "the stream");
  shape.tile_bytes_low = static_cast<uint32_t>(tile_bytes);
  shape.tile_bytes_high = static_cast<uint32_t>(tile_bytes >> 32);
}

}  // namespace

ByteRange coded_range(const StreamView& stream) {
  const SectionEntry& root = stream.entry(Section::kRoot);
  const SectionEntry& tile = stream.entry(Section::kTile);
  return {root.offset, tile.offset + tile.size - root.offset};
}

bool has_references(const LevelShape& level) {
  return level.keyed || level.group_rows() != level.rows || level.group_cols() != level.cols;
}

uint64_t reference_count(const Geometry& geometry) {
  uint64_t count = 0;
  for (int l = 0; l <= geometry.top(); ++l) {
    const LevelShape& level = geometry.level(l);
    if (has_references(level)) count += uint64_t{level.group_rows()} * level.group_cols();
  }
  return count;
}

uint64_t reference_words(const Geometry& geometry) {
  uint64_t words = 0;
  for (const Plane p : kPlanes) {
    const PlaneShape& plane = geometry.plane(p);
    words += uint64_t{row_words(plane)} * plane.height;
  }
  return words;
}

StreamShapeRecord stream_shape(const StreamView& stream, uint32_t stream_chunk_log2,
                               uint32_t reference_chunk_log2) {
  const StreamHeader& header = stream.header;
  checked_words(4 * reference_count(stream.geometry) * reference_words(stream.geometry),
                "the reference area");
  const VectorWidths widths = vector_widths(header.window);
  StreamShapeRecord shape{};
  shape.features = header.feature_flags;
  shape.block_log2 = header.block_log2;
  shape.window = static_cast<uint32_t>(header.window);
  shape.depth = static_cast<uint32_t>(header.depth);
  shape.cluster_rows = header.cluster_rows;
  shape.cluster_cols = header.cluster_cols;
  shape.top = static_cast<uint32_t>(header.tree_height);
  shape.tiles_per_image = static_cast<uint32_t>(stream.geometry.tiles_per_image());
  shape.vector_precision = header.vector_precision;
  shape.disparity_precision =
      header.has(Feature::kSharedDisparity) ? header.disparity_precision : header.vector_precision;
  shape.motion_tile_log2 = header.motion_tile_log2;
  shape.disparity_grid_log2 = header.disparity_grid_log2;
  shape.row_scale = header.row_scale;
  shape.component_bits = widths.component_bits;
  shape.max_code = widths.max_code;
  shape.code_bits = widths.code_bits;
  shape.stream_chunk_log2 = stream_chunk_log2;
  shape.reference_chunk_log2 = reference_chunk_log2;
  shape.reference_words = static_cast<uint32_t>(reference_words(stream.geometry));
  shape.chroma_halved = header.chroma_format == ChromaFormat::k420 ? 1 : 0;
  shape.cluster_row_inverse = inverse_of(shape.cluster_rows);
  shape.cluster_col_inverse = inverse_of(shape.cluster_cols);
  fill_levels(stream.geometry, header.has(Feature::kBalancedGroups), shape);
  fill_planes(stream, shape);
  fill_sections(stream, shape);
  return shape;
}

}  // namespace hmlfc::gpu
