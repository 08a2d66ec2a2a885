// The golden decoder: one block, from the file's bytes to samples (section 8 of the specification).
#pragma once

#include <hmlfc/error.hpp>

#include "decoder/block_values.hpp"
#include "decoder/decode_sources.hpp"
#include "syntax/probe.hpp"

namespace hmlfc {

/// The level at which decoding image `image` of level `level` begins: the lowest, from `level` up,
/// at which the ancestor is a key image, or the top (DEC-1, EXT-5).
int first_level(const Geometry& geometry, int level, ImagePos image);

/// Decodes the block at `site`, in an image of level site.level, and its ancestors before it
/// (DEC-1). The site exists. `probe` watches; its site is not used. Result: samples in [lo, hi].
/// Errors: the first that the steps of section 8 meet, from the top level down (CNV-7).
Result<BlockValues> decode_block(const DecodeSources& sources, const BlockSite& site,
                                 const Probe& probe);

}  // namespace hmlfc
