// Encoding one plane of one image that is coded in blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "decoder/sample_plane.hpp"
#include "encoder/block_choice.hpp"
#include "encoder/reference_plane.hpp"
#include "syntax/geometry.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

/// What the blocks of one plane are coded with.
struct PlaneTask {
  const Geometry* geometry = nullptr;
  Plane plane = Plane::kY;
  int depth = 8;
  int window = 0;
  bool both_signs = true;                     ///< search the additive phase too
  uint32_t threshold = 0;                     ///< energy below which a block is dropped
  const SamplePlane* original = nullptr;      ///< whole blocks, borders extended
  const SamplePlane* parent = nullptr;        ///< reconstructed, whole blocks; null at the top: 0
  const ReferencePlane* reference = nullptr;  ///< null in a reference image
};

/// The tile records of one plane, in tile order, one after another.
struct PlaneCode {
  std::vector<uint32_t> record_sizes;  ///< bytes of each tile's record, 0 where it is empty
  std::vector<uint8_t> records;
};

/// A plane encoded, and what a decoder makes of it.
struct EncodedPlane {
  PlaneCode code;
  SamplePlane samples;    ///< reconstructed (DEC-3), whole blocks
  SamplePlane residuals;  ///< TIL-10, 0 where there is none: what motion refers to; whole blocks
};

/// Encodes a plane block by block: zero where the energy (sum of absolute values) of the
/// difference to the parent lies below the threshold; else motion only where that of the best match
/// does; else the cheaper of a residual with and without motion. Exact residuals, closed loop.
EncodedPlane encode_plane(const PlaneTask& task);

}  // namespace hmlfc
