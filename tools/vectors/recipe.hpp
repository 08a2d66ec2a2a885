// Recipes: how each vector of the suite is made (vectors/README.md, recipes).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "vectors/json.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::vectors {

/// One vector as its recipe says it.
struct Recipe {
  std::string id;  ///< group/name
  std::string group;
  std::vector<std::string> clauses;
  std::vector<std::string> flags;
  std::string comment;
  uint64_t seed = 1;
  Json stream;                      ///< how the bytes are made (stream_recipe.hpp)
  std::vector<BlockAddress> trace;  ///< blocks to be traced
  Expectation expect;               ///< stated by hand, from the specification; its offset is
  Json offset;                      ///< how: vectors/README.md, expectations
};

/// Recipes by id.
using Recipes = std::map<std::string, Recipe>;

/// All recipes of `folder`, the files *.json in it. Throws TextError: no recipe, two of one id, or
/// one that cannot be read, with its file and id.
Recipes read_recipes(const std::filesystem::path& folder);

/// The block that a recipe writes as {"view": [r, c], "plane": "Y", "block": [bx, by]}.
BlockAddress block_of(const Json& json);

/// The plane named "Y", "Co" or "Cg".
Plane plane_from(const Json& json);

}  // namespace hmlfc::vectors
