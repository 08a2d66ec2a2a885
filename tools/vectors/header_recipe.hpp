// Headers from recipes.
#pragma once

#include <hmlfc/format.hpp>

#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// The header whose fields `json` names as FIL-1 and EXT-2 do; "features" lists flags by name,
/// "levels" reference groups [ref_rows, ref_cols] or [ref_rows, ref_cols, key_references] from
/// level 0 on, the last of them for all levels above. What it does not name: one view of 16 x 16
/// pixels, depth 8, 4:2:0, blocks of 4, window 16, no tree, no groups. Throws TextError where the
/// fields break FIL-1 or EXT-2.
StreamHeader header_from(const Json& json);

/// What the header says, as flags of a vector: "extended", "depth10", "predictive" ...
std::vector<std::string> header_flags(const StreamHeader& header);

}  // namespace hmlfc::vectors
