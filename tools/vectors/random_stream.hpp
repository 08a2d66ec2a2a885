// Random valid streams over all syntax.
#pragma once

#include <cstdint>
#include <vector>

#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// What random streams keep to. Every bound is the greatest value.
struct Limits {
  uint32_t grid_side = 5;    ///< rows and cols, each, [1, 4096]
  uint32_t view_side = 70;   ///< width and height, each, [1, 65536]
  int depth = 12;            ///< [8, 12]
  int window = 127;          ///< [0, 127]
  int tree_height = 3;       ///< [0, 15]
  bool main = true;          ///< whether streams may be of profile main
  bool extended = true;      ///< whether streams may be of profile extended
  unsigned block_sizes = 7;  ///< bit i: blocks of 2 << i may occur, not 0
};

/// The limits that a recipe names; the default of the others.
Limits limits_from(const Json& json);

/// A valid stream: both profiles, any features that fit together, block sizes, formats, depths,
/// grids, groups, and every field over its whole interval. The same bytes for the same arguments
/// on every machine. All blocks decode. Throws std::bad_alloc.
std::vector<uint8_t> random_stream(uint64_t seed, const Limits& limits);

}  // namespace hmlfc::vectors
