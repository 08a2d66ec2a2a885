// Writing level parameters, block headers and values of the residual blocks of a tile (TIL-8,
// TIL-9, STP-1).
#pragma once

#include <optional>
#include <span>

#include "bits/bit_writer.hpp"
#include "samples/block_values.hpp"

namespace hmlfc {

/// Appends the fields from level_base to the last block value. `blocks`: at least one, residuals
/// before the step, each in [-M, M]. `step_code` in [0, 15]: of all blocks; without it the stream
/// has no step fields.
void put_residual_blocks(BitWriter& writer, std::span<const BlockValues* const> blocks, int depth,
                         std::optional<unsigned> step_code);

}  // namespace hmlfc
