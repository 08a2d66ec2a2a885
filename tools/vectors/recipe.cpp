#include "vectors/recipe.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace hmlfc::vectors {
namespace {

Expectation expectation_of(const Json& json) {
  Expectation expect;
  expect.outcome =
      json.value("outcome", "reject") == "acceptable" ? Outcome::kAcceptable : Outcome::kReject;
  const auto name = json.at("error").get<std::string>();
  const auto error = error_from_name(name);
  if (!error) throw TextError("\"" + name + "\" is not an error of annex A");
  expect.error = *error;
  for (const Json& block : json.value("blocks", Json::array())) {
    expect.blocks.push_back(block_of(block));
  }
  expect.operation = expect.blocks.empty() ? Operation::kOpen : Operation::kBlock;
  return expect;
}

bool is_name(const std::string& name) {
  return !name.empty() &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
}

void check_keys(const Json& json) {
  static const std::set<std::string> known{"name", "clauses", "flags",  "comment",
                                           "seed", "stream",  "expect", "trace"};
  for (const auto& [key, value] : json.items()) {
    if (!known.contains(key)) throw TextError("a recipe has no \"" + key + "\"");
  }
}

// `defaults`: the stream that all recipes of a file start from.
Recipe recipe_of(const Json& json, const std::string& group, const Json& defaults) {
  check_keys(json);
  Recipe recipe;
  const auto name = json.at("name").get<std::string>();
  if (!is_name(name) || !is_name(group)) throw TextError("names consist of a-z, 0-9 and -");
  recipe.id = group + "/" + name;
  recipe.group = group;
  recipe.clauses = json.at("clauses");
  recipe.flags = json.value("flags", std::vector<std::string>{});
  recipe.comment = json.at("comment");
  recipe.seed = json.value("seed", uint64_t{1});
  recipe.stream = defaults;
  recipe.stream.merge_patch(json.value("stream", Json::object()));
  for (const Json& block : json.value("trace", Json::array())) {
    recipe.trace.push_back(block_of(block));
  }
  if (json.contains("expect")) {
    recipe.expect = expectation_of(json["expect"]);
    recipe.offset = json["expect"].at("offset");
  }
  return recipe;
}

void read_recipe_file(const std::filesystem::path& file, Recipes& recipes) {
  const Json json = read_json(file);
  const Json defaults = json.value("stream", Json::object());
  for (const Json& one : json.at("vectors")) {
    try {
      Recipe recipe = recipe_of(one, json.at("group"), defaults);
      if (const auto name = recipe.stream.find("file"); name != recipe.stream.end()) {
        *name = (file.parent_path() / name->get<std::string>()).string();
      }
      const std::string id = recipe.id;
      if (!recipes.emplace(id, std::move(recipe)).second) throw TextError("a second " + id);
    } catch (const std::exception& error) {
      throw TextError(file.string() + ": " + one.value("name", "?") + ": " + error.what());
    }
  }
}

}  // namespace

Plane plane_from(const Json& json) {
  for (const Plane plane : kPlanes) {
    if (json == plane_name(plane)) return plane;
  }
  throw TextError(json.dump() + " is not a plane");
}

BlockAddress block_of(const Json& json) {
  const Json& view = json.at("view");
  const Json& block = json.at("block");
  return {{view.at(0), view.at(1)}, plane_from(json.at("plane")), block.at(0), block.at(1)};
}

Recipes read_recipes(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (files.empty()) throw TextError(folder.string() + ": no recipes (*.json) there");
  std::sort(files.begin(), files.end());
  Recipes recipes;
  for (const auto& file : files) read_recipe_file(file, recipes);
  return recipes;
}

}  // namespace hmlfc::vectors
