// From a block's place to the bits of its tile's record and what they mean.
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/error.hpp>
#include <hmlfc/trace.hpp>

#include "bits/bit_string.hpp"
#include "fields/probe.hpp"
#include "fields/stream_view.hpp"
#include "fields/tile_head.hpp"

namespace hmlfc {

/// The record of one tile.
struct TileRecord {
  BitString bits;
  uint64_t file_bit = 0;  ///< address of its first bit from the start of the file
};

/// The record of the tile that holds block `site`, which exists and is not in a key image; nothing
/// where the tile is empty (IDX-7). Errors: those of find_tile.
Result<std::optional<TileRecord>> find_record(const StreamView& stream, const BlockSite& site,
                                              const Probe& probe);

/// What the place of that tile says about its record.
TileContext tile_context(const StreamView& stream, const BlockSite& site);

}  // namespace hmlfc
