// The golden decoder: one block, from the file's bytes to samples (section 8 of the specification).
#pragma once

#include <hmlfc/error.hpp>

#include "fields/probe.hpp"
#include "samples/block_values.hpp"
#include "samples/block_walk.hpp"
#include "samples/key_images.hpp"
#include "samples/sparse_plane.hpp"

namespace hmlfc {

/// Where a decoder finds what it does not read block by block.
struct DecodeSources {
  const StreamView& stream;
  const KeyImages& keys;
  const SparseReferences* references = nullptr;  ///< null: reference blocks are read on demand
};

/// Decodes the block at `site`, in an image of level site.level, and its ancestors before it
/// (DEC-1). The site exists. `probe` watches; its site is not used. Result: samples in [lo, hi].
/// Errors: the first that the steps of section 8 meet, from the top level down (CNV-7).
Result<BlockValues> decode_block(const DecodeSources& sources, const BlockSite& site,
                                 const Probe& probe);

}  // namespace hmlfc
