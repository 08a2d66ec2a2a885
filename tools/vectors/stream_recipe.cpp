#include "vectors/stream_recipe.hpp"

#include "syntax/header.hpp"
#include "vectors/encode_recipe.hpp"
#include "vectors/field_stream.hpp"
#include "vectors/random_stream.hpp"
#include "vectors/stream_edit.hpp"

namespace hmlfc::vectors {
namespace {

// Bases of bases are followed so far.
constexpr int kMaxDepth = 8;

MadeStream make(const Recipes& recipes, const std::string& id, int depth);

// The base of the recipe with its edits made.
MadeStream edited(const Recipes& recipes, const Recipe& recipe, int depth) {
  MadeStream made = make(recipes, recipe.stream.at("base"), depth + 1);
  for (const Json& edit : recipe.stream.at("edits")) edit_stream(made.bytes, edit);
  return made;
}

std::vector<uint8_t> whole_stream(const Recipe& recipe, const std::string& kind) {
  if (kind == "encode") return encoded_stream(recipe.stream, recipe.seed);
  if (kind == "fields") return field_stream(recipe.stream, recipe.seed);
  if (kind == "random") {
    const Json limits = recipe.stream.value("limits", Json::object());
    return random_stream(recipe.seed, limits_from(limits));
  }
  throw TextError("\"" + kind + "\" is no kind of stream");
}

MadeStream make(const Recipes& recipes, const std::string& id, int depth) {
  const auto recipe = recipes.find(id);
  if (recipe == recipes.end()) throw TextError("there is no recipe " + id);
  if (depth > kMaxDepth) throw TextError("its bases never end");
  const auto kind = recipe->second.stream.at("kind").get<std::string>();
  if (kind == "edit") return edited(recipes, recipe->second, depth);
  MadeStream made;
  made.bytes = whole_stream(recipe->second, kind);
  made.header = parse_header(made.bytes).value();
  return made;
}

}  // namespace

MadeStream make_stream(const Recipes& recipes, const std::string& id) {
  try {
    return make(recipes, id, 0);
  } catch (const std::exception& error) {
    throw TextError(id + ": " + error.what());
  }
}

}  // namespace hmlfc::vectors
