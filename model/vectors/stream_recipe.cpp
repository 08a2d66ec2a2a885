#include "vectors/stream_recipe.hpp"

#include "fields/header.hpp"
#include "vectors/encode_recipe.hpp"

namespace hmlfc::vectors {
namespace {

std::vector<uint8_t> bytes_of(const Recipe& recipe) {
  const auto kind = recipe.stream.at("kind").get<std::string>();
  if (kind == "encode") return encoded_stream(recipe.stream, recipe.seed);
  throw TextError("\"" + kind + "\" is no kind of stream");
}

}  // namespace

MadeStream make_stream(const Recipes& recipes, const std::string& id) {
  try {
    MadeStream made;
    made.bytes = bytes_of(recipes.at(id));
    made.header = parse_header(made.bytes).value();
    return made;
  } catch (const std::exception& error) {
    throw TextError(id + ": " + error.what());
  }
}

}  // namespace hmlfc::vectors
