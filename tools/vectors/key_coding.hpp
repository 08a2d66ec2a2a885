// How recipes have key images coded.
#pragma once

#include "decoder/jpeg2000.hpp"
#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// The options that `json` names, each of them optional: {"style": ["bypass", "reset", "terminate",
/// "causal", "predictable", "segmentation"], "layers": n, "progression": "LRCP", "sop": true,
/// "eph": true, "code_block": [width, height], "decompositions": n, "precinct_log2": n}. Throws
/// TextError.
CodestreamOptions key_coding_from(const Json& json);

}  // namespace hmlfc::vectors
