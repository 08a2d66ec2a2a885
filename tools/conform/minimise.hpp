// The smallest stream found that still makes a decoder fail.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "io/io_error.hpp"

namespace hmlfc::conform {

/// Whether a valid stream still shows the failure.
using StillFails = std::function<bool(std::span<const uint8_t> stream)>;

struct Minimised {
  std::vector<uint8_t> stream;  ///< valid: the golden model decodes all of it
  unsigned trials = 0;          ///< streams that the decoder was run on
  unsigned steps = 0;           ///< reductions that were kept
};

/// Reduces `stream`, which fails, as long as it still fails: levels of the tree, views, pixels and
/// tiles in turn, until none of them helps or `max_trials` streams were tried. The golden model
/// decodes every stream tried. The result depends on the arguments alone.
/// Errors: the golden model does not decode `stream`, or it has more than 2^20 tiles.
io::IoResult<Minimised> minimise(std::span<const uint8_t> stream, const StillFails& still_fails,
                                 unsigned max_trials);

}  // namespace hmlfc::conform
