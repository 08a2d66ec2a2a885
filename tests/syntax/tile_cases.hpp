// Random tiles for the tests of tile records.
#pragma once

#include <cstdint>
#include <vector>

#include "syntax/tile_record.hpp"
#include "vectors/draw.hpp"

namespace hmlfc::test {

/// A tile and what its place in the tree says about its record.
struct TileCase {
  TileContext context;
  TileFields tile;

  std::vector<uint8_t> record() const { return write_tile_fields(tile, context); }
};

/// A random context with a random set of blocks inside, that of some border tile.
inline TileContext draw_context(vectors::Random& random) {
  TileContext context;
  context.predictive = random.below(4) != 0;
  PlaneShape plane;
  const bool whole = random.below(2) == 0;
  plane.blocks_x = whole ? 8 : random.within(1, 8);
  plane.blocks_y = whole ? 8 : random.within(1, 8);
  context.blocks_inside = blocks_inside(plane, 0, 0);
  context.window = static_cast<int>(random.below(random.below(2) == 0 ? 128 : 4));
  context.depth = static_cast<int>(random.within(8, 12));
  context.block_samples = uint64_t{4} << (2 * random.below(3));
  context.steps = random.below(2) == 0;
  return context;
}

/// A valid tile of random content that is not empty.
inline TileCase draw_tile_case(vectors::Random& random, const TileContext& context) {
  vectors::FieldRules rules;
  for (;;) {
    if (auto tile = vectors::draw_tile(rules, context, random)) return {context, *tile};
  }
}

}  // namespace hmlfc::test
