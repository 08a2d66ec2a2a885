// ASTC blocks that carry a given weight grid, and what an ASTC decoder makes of it; after the
// Khronos Data Format Specification, chapter ASTC.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bits/naive_bits.hpp"

namespace hmlfc::test {

/// A grid of width x height weights of `levels` levels.
struct WeightGrid {
  unsigned width = 0;
  unsigned height = 0;
  uint32_t levels = 0;

  unsigned count() const { return width * height; }
};

/// Texels along each side of the blocks below.
inline constexpr unsigned kFootprint = 12;

/// The block mode field (11 bits) of the grid, one weight plane; nothing where ASTC has none.
std::optional<uint32_t> astc_block_mode(const WeightGrid& grid);

/// A block of one partition whose weights are `sequence`, in [24, 96] bits; the rest is 0.
std::array<uint8_t, 16> astc_block(uint32_t block_mode, const NaiveBits& sequence);

/// The weights in [0, 64] of the 12 x 12 texels for the grid's values: unquantised, then
/// interpolated.
std::vector<uint32_t> astc_texel_weights(const WeightGrid& grid,
                                         const std::vector<uint32_t>& values);

}  // namespace hmlfc::test
