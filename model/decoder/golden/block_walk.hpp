// One walk (BND-1): from a block's place to its entry and residual.
#pragma once

#include <hmlfc/error.hpp>

#include "decoder/block_values.hpp"
#include "syntax/block_entry.hpp"
#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// A block as the stream holds it.
struct CodedBlock {
  BlockEntry entry;
  BlockValues residual;  ///< all 0 without a residual; each in [-M, M]
};

/// Finds and reads the block at `probe.site`, which exists and is not in a key image: index, tile
/// head, entry, values. Errors: those of find_tile, read_tile_head and read_block_entry.
Result<CodedBlock> walk_to_block(const StreamView& stream, const Probe& probe);

}  // namespace hmlfc
