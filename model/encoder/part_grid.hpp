// Parts of a light field that fit in memory.
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/divided_encoder.hpp>

#include "encoder/encode_part.hpp"

namespace hmlfc {

/// The views of part `part` in [0, grid.count() - 1].
ImageRange views_of_part(const PartGrid& grid, size_t part);

/// Whether the parts of `grid` make up the views of `header`.
bool covers(const PartGrid& grid, const StreamHeader& header);

/// A division, and on how many threads its parts fit.
struct FittingParts {
  PartGrid grid;
  int threads = 1;
  uint64_t bytes = 0;  ///< of the largest part
};

/// The largest parts that take at most `memory` bytes each with `preset`, on at most `threads`
/// threads: more threads come first. None: not even one view fits; `least` is what it takes.
std::optional<FittingParts> fitting_parts(const StreamHeader& header, Preset preset,
                                          uint64_t memory, int threads, uint64_t& least);

/// Parts small enough to be shared out: two by two reference groups, or an image of the tree's top.
PartGrid small_parts(const StreamHeader& header);

}  // namespace hmlfc
