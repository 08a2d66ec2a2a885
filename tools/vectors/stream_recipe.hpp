// From a recipe to the header and the bytes of a stream.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <hmlfc/format.hpp>

#include "vectors/json.hpp"
#include "vectors/recipe.hpp"

namespace hmlfc::vectors {

/// The header whose fields `json` names as FIL-1 and EXT-2 do; "features" lists flags by name,
/// "levels" reference groups [ref_rows, ref_cols] or [ref_rows, ref_cols, key_references] from
/// level 0 on, the last of them for all levels above. What it does not name: one view of 16 x 16
/// pixels, depth 8, 4:2:0, blocks of 4, window 16, no tree, no groups. Throws TextError where the
/// fields break FIL-1 or EXT-2.
StreamHeader header_from(const Json& json);

/// What the header says, as flags of a vector: "extended", "depth10", "predictive" ...
std::vector<std::string> header_flags(const StreamHeader& header);

/// A stream with the header that it was made with, before any edit.
struct MadeStream {
  std::vector<uint8_t> bytes;
  StreamHeader header;
};

/// The stream of recipe `id`, whose "stream" has "kind"
///   "encode"  what the encoder makes of a scene (encode_recipe.hpp),
///   "fields"  every field by a rule (field_stream.hpp),
///   "random"  a random stream within "limits" (random_stream.hpp),
///   "edit"    the stream of recipe "base" with "edits" (stream_edit.hpp).
/// Throws TextError, with the id.
MadeStream make_stream(const Recipes& recipes, const std::string& id);

/// The stream of {"scene": {"name", "rows", "cols", "width", "height", "depth", "baseline"},
/// "encode": {...}}: the options of EncodeParams by name. `seed`: of the scene. Throws TextError
/// for a name or value that is none, or where the encoder refuses.
std::vector<uint8_t> encoded_stream(const Json& json, uint64_t seed);

}  // namespace hmlfc::vectors
