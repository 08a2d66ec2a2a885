// What the kernels know of a stream: the layout of shaders/stream_shape.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

struct LevelShapeRecord {
  uint32_t rows, cols;
  uint32_t ref_rows, ref_cols;
  uint32_t group_rows, group_cols;
  uint32_t first_image;
  uint32_t first_reference;
  uint32_t keyed;
  uint32_t row_inverse, col_inverse;
  uint32_t group_row_inverse, group_col_inverse;
  uint32_t pad[3] = {};
};

struct PlaneShapeRecord {
  uint32_t width, height;
  uint32_t blocks_x, blocks_y;
  uint32_t tiles_x, tiles_y;
  uint32_t first_tile;
  uint32_t motion_plane;
  uint32_t halved;
  uint32_t row_words, first_word;
  int32_t lo, hi, bound;
  uint32_t pad[2] = {};
};

struct MotionPlaneShapeRecord {
  uint32_t width, height;
  uint32_t tiles_x, tiles_y;
  uint32_t first_tile;
  uint32_t pad[3] = {};
};

struct StreamShapeRecord {
  uint32_t features;
  uint32_t block_log2;
  uint32_t window;
  uint32_t depth;
  uint32_t cluster_rows, cluster_cols;
  uint32_t top;
  uint32_t tiles_per_image;
  uint32_t vector_precision, disparity_precision;
  uint32_t motion_tile_log2, disparity_grid_log2;
  int32_t row_scale;
  uint32_t component_bits, max_code, code_bits;
  uint32_t group_word, group_records;
  uint32_t tile_word;
  uint32_t tile_bytes_low, tile_bytes_high;
  uint32_t stream_chunk_log2;
  uint32_t reference_chunk_log2;
  uint32_t reference_words;
  uint32_t chroma_halved;
  uint32_t cluster_row_inverse, cluster_col_inverse;
  uint32_t pad;
  std::array<LevelShapeRecord, 16> levels;
  std::array<PlaneShapeRecord, 3> planes;
  std::array<MotionPlaneShapeRecord, 2> motion_planes;
};

/// Returns where the sections ROOT, GROUP and TILE lie, which follow each other in the file.
ByteRange coded_range(const StreamView& stream);

/// Returns whether blocks of `level` read its reference images: it is keyed, or some of its images
/// are predictive. Only these levels are in the reference area.
bool has_references(const LevelShape& level);

/// Returns the number of reference images in the reference area.
uint64_t reference_count(const Geometry& geometry);

/// Returns the words of one reference image in the reference area: its three planes, rows of whole
/// words.
uint64_t reference_words(const Geometry& geometry);

/// Returns the shape of `stream`, whose chunks have 2^`stream_chunk_log2` words, and those of its
/// reference area 2^`reference_chunk_log2`. ROOT begins with word 0 of the uploaded stream. Throws
/// MachineError beyond 2^32 words of either.
StreamShapeRecord stream_shape(const StreamView& stream, uint32_t stream_chunk_log2,
                               uint32_t reference_chunk_log2);

}  // namespace hmlfc::gpu
