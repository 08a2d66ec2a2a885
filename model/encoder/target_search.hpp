// The search for the encoding that meets a target with the least loss.
#pragma once

#include <functional>

#include <hmlfc/encoder.hpp>

#include "encoder/encode_goal.hpp"

namespace hmlfc {

/// Encodes with parameters of which nothing is open.
using EncodeAttempt = std::function<EncodedStream(const EncodeParams&)>;

/// Varies quality, in eighths (in profile main: both thresholds, equal), from that of `params` on.
/// Returns the encoding nearest to `goal` that meets it, or the nearest that can be had; as far as
/// PSNR and bytes grow with quality. `shape`: of what is encoded.
EncodedStream search_target(const LightFieldShape& shape, const EncodeParams& params,
                            const EncodeGoal& goal, const EncodeAttempt& attempt);

}  // namespace hmlfc
