#include "vectors/recipe.hpp"

#include <algorithm>
#include <array>
#include <new>
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

void check_keys(const Json& json) {
  static const std::set<std::string> known{"name",   "clauses", "flags", "comment", "seed",
                                           "stream", "expect",  "trace", "listed"};
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
  recipe.listed = json.value("listed", true);
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

std::string text_of(const Json& json, const char* key) { return json.at(key).get<std::string>(); }

std::set<std::string> names_of(const Json& errors, const char* key) {
  return errors.value(key, std::set<std::string>{});
}

// Whether a vector can hold both errors, and a decoder can show by a name which it met first.
bool is_pair(const Json& first, const Json& second) {
  return first.at("error") != second.at("error") &&
         !names_of(first, "without").contains(second.at("name")) &&
         !names_of(second, "without").contains(first.at("name"));
}

// The recipe of the base of `family` with `edits` and the error of `first`.
Json edited_recipe(const Json& family, const std::string& name, const Json& first, Json edits) {
  Json expect{{"error", first.at("error")}, {"offset", first.at("offset")}};
  if (family.contains("blocks")) expect["blocks"] = family["blocks"];
  return {{"name", text_of(family, "name") + "-" + name},
          {"clauses", family.at("clauses")},
          {"comment", first.at("comment")},
          {"stream", {{"kind", "edit"}, {"base", family.at("base")}, {"edits", std::move(edits)}}},
          {"expect", expect}};
}

// The recipe of a stream with both errors of `family`. The later one is edited in first, so that
// fields before it are still read when the other is; a wrong checksum, which the mending after the
// other's edits would correct, after the errors that it names in "after". If other views meet it
// too, they get the first error before it, so that a decoder of whole views has no other name to
// give.
Json pair_recipe(const Json& family, const Json& first, const Json& second) {
  Json edits = second.value("elsewhere", false) ? first.at("cover") : Json::array();
  std::array order{&second, &first};
  if (names_of(second, "after").contains(first.at("name"))) std::ranges::reverse(order);
  for (const Json* error : order) {
    const Json& own = error->at("edits");
    edits.insert(edits.end(), own.begin(), own.end());
  }
  const std::string name = text_of(first, "name") + "-" + text_of(second, "name");
  Json recipe = edited_recipe(family, name, first, edits);
  auto clauses = names_of(family, "clauses");
  for (const Json* error : {&first, &second}) clauses.merge(names_of(*error, "clauses"));
  recipe["clauses"] = clauses;
  recipe["comment"] = text_of(first, "comment") + ", and then " + text_of(second, "comment");
  return recipe;
}

// The recipes of a file: its vectors, and one for each two errors of each family of "pairs", whose
// errors stand in the order in which they are checked. Each error alone is a recipe that is not
// listed: it shows that the error is there, and would be met without the other.
std::vector<Json> recipes_in(const Json& json) {
  std::vector<Json> recipes = json.value("vectors", std::vector<Json>{});
  for (const Json& family : json.value("pairs", Json::array())) {
    const Json& errors = family.at("errors");
    for (auto first = errors.begin(); first != errors.end(); ++first) {
      recipes.push_back(edited_recipe(family, text_of(*first, "name"), *first, first->at("edits")));
      recipes.back()["listed"] = false;
      for (auto second = first + 1; second != errors.end(); ++second) {
        if (is_pair(*first, *second)) recipes.push_back(pair_recipe(family, *first, *second));
      }
    }
  }
  return recipes;
}

void read_recipe_file(const std::filesystem::path& file, Recipes& recipes) {
  const Json json = read_json(file);
  const Json defaults = json.value("stream", Json::object());
  for (const Json& one : recipes_in(json)) {
    try {
      Recipe recipe = recipe_of(one, json.at("group"), defaults);
      if (const auto name = recipe.stream.find("file"); name != recipe.stream.end()) {
        *name = (file.parent_path() / name->get<std::string>()).string();
      }
      const std::string id = recipe.id;
      if (!recipes.emplace(id, std::move(recipe)).second) throw TextError("a second " + id);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw TextError(file.string() + ": " + one.value("name", "?") + ": " + error.what());
    }
  }
}

constexpr const char* kFrames = "frames.json";

}  // namespace

std::map<std::string, Json> read_frame_recipes(const std::filesystem::path& folder) {
  std::map<std::string, Json> recipes;
  const Json json = read_json(folder / kFrames);
  for (const Json& family : json.at("families")) {
    for (const Json& one : family.at("cases")) {
      Json recipe = family;
      recipe.erase("cases");
      recipe.merge_patch(one);
      const std::string id = "frames/" + text_of(recipe, "name");
      if (!recipes.emplace(id, std::move(recipe)).second) throw TextError("a second " + id);
    }
  }
  return recipes;
}

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
    if (entry.path().extension() == ".json" && entry.path().filename() != kFrames)
      files.push_back(entry.path());
  }
  if (files.empty()) throw TextError(folder.string() + ": no recipes (*.json) there");
  std::sort(files.begin(), files.end());
  Recipes recipes;
  for (const auto& file : files) read_recipe_file(file, recipes);
  return recipes;
}

}  // namespace hmlfc::vectors
