// Writing the masks of a tile (TIL-3).
#pragma once

#include <cstdint>

#include "bits/bit_writer.hpp"

namespace hmlfc {

/// Modes of TIL-3.
enum MaskMode : uint32_t { kMaskNone = 0, kMaskAll = 1, kMaskRaw = 2, kMaskQuads = 3 };

/// The mode in which `mask` takes the fewest bits; `inside`: the blocks of the tile in the plane.
uint32_t mask_mode(uint64_t mask, uint64_t inside);

/// Bits of `mask` in `mode`.
unsigned mask_bits(uint64_t mask, uint32_t mode);

/// Appends `mask` in `mode`.
void put_mask(BitWriter& writer, uint64_t mask, uint32_t mode);

}  // namespace hmlfc
