// Writing tile records (TIL-1 to TIL-10).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "encoder/block_choice.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

/// The record of a tile. `choices` has one entry for each block number; those outside the plane are
/// in state zero. Empty where all blocks are zero (IDX-7).
std::vector<uint8_t> write_tile(std::span<const BlockChoice> choices, const TileContext& context);

}  // namespace hmlfc
