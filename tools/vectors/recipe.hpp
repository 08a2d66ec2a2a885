// Recipes: how each vector of the suite is made (vectors/README.md, recipes).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/format.hpp>

#include "vectors/json.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::vectors {

/// One vector as its recipe states it.
struct Recipe {
  std::string id;  ///< group/name
  std::string group;
  std::vector<std::string> clauses;
  std::vector<std::string> flags;
  std::string comment;
  uint64_t seed = 1;
  Json stream;                      ///< how the bytes are made: make_stream()
  std::vector<BlockAddress> trace;  ///< traced blocks
  Expectation expect;               ///< stated by hand, from the specification; its offset is
  Json offset;                      ///< how: vectors/README.md, expectations
  bool listed = true;               ///< false: checked with the others, but no vector of the suite
};

/// Recipes by id.
using Recipes = std::map<std::string, Recipe>;

/// All recipes of `folder`, the files *.json in it. Throws TextError: no recipe, two of one id, or
/// one that cannot be read, with its file and id.
Recipes read_recipes(const std::filesystem::path& folder);

/// The recipes of frames in the file frames.json of `folder`, by id: families with their cases
/// merged into them (vectors/README.md, recipes). Throws TextError.
std::map<std::string, Json> read_frame_recipes(const std::filesystem::path& folder);

/// The block that a recipe writes as {"view": [r, c], "plane": "Y", "block": [bx, by]}.
BlockAddress block_of(const Json& json);

/// The plane named "Y", "Co" or "Cg".
Plane plane_from(const Json& json);

/// A stream with the header that it was made with, before any edit.
struct MadeStream {
  std::vector<uint8_t> bytes;
  StreamHeader header;
};

/// The stream of recipe `id`, whose "stream" has "kind"
///   "encode"  what the encoder makes of a scene (see below),
///   "file"    that of "file", by its path relative to the recipe: what an earlier encoder made,
///   "fields"  every field by a rule (field_stream.hpp),
///   "random"  a random stream within "limits" (field_stream.hpp),
///   "edit"    the stream of recipe "base" with "edits" (stream_edit.hpp).
/// Throws TextError, with the id.
MadeStream make_stream(const Recipes& recipes, const std::string& id);

/// The stream of {"scene": {"name", "rows", "cols", "width", "height", "depth", "baseline"},
/// "encode": {...}}: the options of EncodeParams by name. `seed`: of the scene. Throws TextError
/// for an unknown name or value, or if the encoder rejects them.
std::vector<uint8_t> encoded_stream(const Json& json, uint64_t seed);

}  // namespace hmlfc::vectors
