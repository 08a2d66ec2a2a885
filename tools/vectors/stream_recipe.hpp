// From the "stream" of a recipe to the bytes of a stream.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <hmlfc/format.hpp>

#include "vectors/recipe.hpp"

namespace hmlfc::vectors {

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

}  // namespace hmlfc::vectors
