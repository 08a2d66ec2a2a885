// The golden decoder: one block, from the file's bytes to samples, as section 8 of the
// specification reads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include <hmlfc/error.hpp>

#include "decoder/block_motion.hpp"
#include "decoder/key_images.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// Reference images below the keyed levels that somebody else decoded and holds (DEC-7).
class HeldReferences {
 public:
  virtual ~HeldReferences() = default;

  /// The residuals of the block at `site` or its error, both as walk_to_block gives them.
  virtual Result<BlockValues> block(const BlockSite& site) const = 0;
};

/// Sources of the golden decoder.
struct DecodeSources {
  const StreamView& stream;
  const KeyImages& keys;
  const HeldReferences* held = nullptr;  ///< null: the decoder reads reference blocks by itself
};

/// The level at which decoding image `image` of level `level` begins: the lowest, from `level` up,
/// at which the ancestor is a key image, or the top (DEC-1, EXT-5).
int first_level(const Geometry& geometry, int level, ImagePos image);

/// Decodes the block at `site`, in an image of level site.level, and its ancestors before it
/// (DEC-1). The site exists. `probe` watches; its site is not used. Result: samples in [lo, hi].
/// Errors: the first that the steps of section 8 meet, from the top level down (CNV-7).
Result<BlockValues> decode_block(const DecodeSources& sources, const BlockSite& site,
                                 const Probe& probe);

/// The blocks of `rect` by decode_block, row by row: (bx1 - bx0) * B x (by1 - by0) * B samples;
/// those outside the plane have no meaning. The error is that of the first block that does not
/// decode (CNV-7).
Result<SamplePlane> decode_region_by_blocks(const DecodeSources& sources, int level, ImagePos image,
                                            Plane plane, const BlockRect& rect);

/// Values of ref around a displaced block: B or B + 1 a side.
class ReferenceWindow {
 public:
  ReferenceWindow(unsigned columns, unsigned rows) : columns_(columns), rows_(rows) {}

  unsigned columns() const { return columns_; }
  unsigned rows() const { return rows_; }

  int32_t& at(unsigned x, unsigned y) { return values_[y * columns_ + x]; }
  int32_t at(unsigned x, unsigned y) const { return values_[y * columns_ + x]; }

 private:
  unsigned columns_;
  unsigned rows_;
  std::array<int32_t, size_t{kMaxBlockSize + 1} * (kMaxBlockSize + 1)> values_{};
};

/// Gives block (bx, by) of a plane, which exists; positions outside the plane have no meaning.
using BlockReader = std::function<Result<BlockValues>(uint32_t bx, uint32_t by)>;

/// The values of ref in `area`, of at most B + 1 columns and rows, with the border rule (DEC-5).
/// Asks for at most 2 x 2 blocks, row by row.
///
/// Example: B = 4, columns -6 to -3, rows 5 to 8 in a wide plane: all columns read column 0.
Result<ReferenceWindow> gather_reference(const BlockReader& read_block, const PlaneShape& plane,
                                         unsigned block_size, const ReferenceArea& area);

}  // namespace hmlfc
