// What a block with motion is predicted from (DEC-4, DEC-5, MOT-9).
#pragma once

#include <hmlfc/error.hpp>

#include "decoder/block_motion.hpp"
#include "decoder/block_values.hpp"
#include "decoder/decode_sources.hpp"
#include "syntax/probe.hpp"

namespace hmlfc {

/// R of MOT-9 over the block at `probe.site`, in [-M, M]; ref(x + dx, y + dy) of DEC-3 with one
/// reference and a vector of whole samples. `motion` has a reference. Reads the reference blocks of
/// the first reference, then of the second, each row by row (DEC-7, MOT-10). Errors: those of
/// reading these.
Result<BlockValues> read_motion_reference(const DecodeSources& sources, const BlockMotion& motion,
                                          const Probe& probe);

}  // namespace hmlfc
