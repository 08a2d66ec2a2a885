// Level parameters, block headers and values that code the residual blocks of a tile (TIL-8, TIL-9,
// STP-1).
#pragma once

#include <span>

#include "decoder/sample_plane.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

/// The fields of least size for `blocks`: at least one, residuals before the step, each in [-M, M].
/// `step_code` in [0, 15]: of all blocks; 0 in a stream without steps.
ResidualFields residual_fields(std::span<const BlockValues* const> blocks, int depth,
                               unsigned step_code);

}  // namespace hmlfc
