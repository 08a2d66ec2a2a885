// Every block of a plane of one view, as `inspect` sees it, in arrays.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc::view {

/// The stages of a block, as trace.hpp names them.
inline constexpr std::array<std::string_view, 5> kStageNames{"sample", "prediction", "reference",
                                                             "residual", "parent"};

/// In a stage: the block does not have it.
inline constexpr int16_t kNoSample = INT16_MIN;

/// States besides those of BlockState.
inline constexpr int kKeyBlock = 4;      ///< of a key image
inline constexpr int kCorruptBlock = 5;  ///< has an error

/// A vector into a reference image.
struct PlaneVector {
  uint32_t block = 0;
  uint32_t image_row = 0;  ///< of the reference image
  uint32_t image_col = 0;
  int32_t x = 0;  ///< eighths of a sample
  int32_t y = 0;
};

/// An error and the block that has it.
struct PlaneError {
  uint32_t block = 0;
  std::string text;  ///< "bad_levels in TILE at byte 1234: ..."
};

/// What is decoded at the stop level alone. Blocks are counted row by row.
struct PlaneTrace {
  PlaneSize size;                                               ///< samples
  uint32_t columns = 0;                                         ///< of blocks
  uint32_t rows = 0;                                            ///< of blocks
  std::array<std::vector<int16_t>, kStageNames.size()> stages;  ///< row by row; kNoSample
  std::vector<uint8_t> states;                                  ///< BlockState and those above
  std::vector<uint32_t> bits;  ///< of the block alone: its header, values, vector or palette index
  std::vector<uint32_t> read;  ///< of all fields that lead to it at this level
  std::vector<uint32_t> level_counts;  ///< N of its values; 0 without residual
  std::vector<uint32_t> steps;         ///< STP-3; 0 without
  std::vector<PlaneVector> vectors;    ///< by block
  std::vector<PlaneError> errors;      ///< by block
};

/// Samples of a plane that are traced at most.
inline constexpr uint64_t kMaxTracedSamples = uint64_t{1} << 23;

/// Traces every block of plane `plane` of `view`, which is in the grid, down to `stop_level` in
/// [0, tree_height], on all cores. The plane has at most kMaxTracedSamples samples.
PlaneTrace trace_plane(const Decoder& decoder, ViewPos view, Plane plane, int stop_level);

}  // namespace hmlfc::view
