// From a recipe to the bytes of a stream.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <hmlfc/format.hpp>

#include "vectors/json.hpp"
#include "vectors/recipe.hpp"

namespace hmlfc::vectors {

/// A stream with the header that it was made with, before any edit.
struct MadeStream {
  std::vector<uint8_t> bytes;
  StreamHeader header;
};

/// The stream of recipe `id`, whose "stream" has "kind"
///   "encode"  what the encoder makes of a scene (see below),
///   "fields"  every field by a rule (field_stream.hpp),
///   "random"  a random stream within "limits" (field_stream.hpp),
///   "edit"    the stream of recipe "base" with "edits" (stream_edit.hpp).
/// Throws TextError, with the id.
MadeStream make_stream(const Recipes& recipes, const std::string& id);

/// The stream of {"scene": {"name", "rows", "cols", "width", "height", "depth", "baseline"},
/// "encode": {...}}: the options of EncodeParams by name. `seed`: of the scene. Throws TextError
/// for a name or value that is none, or where the encoder refuses.
std::vector<uint8_t> encoded_stream(const Json& json, uint64_t seed);

}  // namespace hmlfc::vectors
