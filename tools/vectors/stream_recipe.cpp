#include "vectors/recipe.hpp"

#include <new>
#include <string>
#include <utility>

#include <hmlfc/encoder.hpp>

#include "io/files.hpp"
#include "scenes/scene.hpp"
#include "syntax/header.hpp"
#include "vectors/field_stream.hpp"
#include "vectors/header_recipe.hpp"
#include "vectors/stream_edit.hpp"

namespace hmlfc::vectors {

namespace {

const Setters<EncodeParams>& encode_setters() {
  static const Setters<EncodeParams> all{
      {"profile",
       word(&EncodeParams::profile, {{"main", Profile::kMain}, {"extended", Profile::kExtended}})},
      {"method", word(&EncodeParams::method,
                      {{"hmlfc", Method::kHmlfc}, {"rlfc", Method::kRlfc}, {"mc", Method::kMc}})},
      {"preset",
       [](EncodeParams& params, const Json& json) {
         params.extended.preset = value_of_word<Preset>(
             json, {{"fast", Preset::kFast}, {"medium", Preset::kMedium}, {"slow", Preset::kSlow}});
       }},
      {"chroma", word(&EncodeParams::chroma, chroma_formats())},
      {"cluster_rows", number(&EncodeParams::cluster_rows)},
      {"cluster_cols", number(&EncodeParams::cluster_cols)},
      {"tree_height", number(&EncodeParams::tree_height)},
      {"block_size", number(&EncodeParams::block_size)},
      {"window", number(&EncodeParams::window)},
      {"ref_rows", number(&EncodeParams::ref_rows)},
      {"ref_cols", number(&EncodeParams::ref_cols)},
      {"threshold_ref",
       [](EncodeParams& p, const Json& json) { json.get_to(p.main.threshold_ref); }},
      {"threshold_pred",
       [](EncodeParams& p, const Json& json) { json.get_to(p.main.threshold_pred); }},
      {"quality", [](EncodeParams& p, const Json& json) { json.get_to(p.extended.quality); }},
      {"lossless", number(&EncodeParams::lossless)},
  };
  return all;
}

// Defaults of recipes, which do not follow the encoder's.
EncodeParams recipe_defaults() {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.tree_height = 3;
  params.window = 16;
  params.ref_rows = params.ref_cols = 8;
  params.chroma = ChromaFormat::k420;
  return params;
}

LightField scene_from(const Json& json, uint64_t seed) {
  scenes::SceneParams params;
  const auto name = json.at("name").get<std::string>();
  const auto scene = scenes::scene_from_name(name);
  if (!scene) throw TextError("\"" + name + "\" is not a scene");
  params.scene = *scene;
  params.rows = json.at("rows");
  params.cols = json.at("cols");
  params.width = json.at("width");
  params.height = json.at("height");
  params.depth = json.value("depth", 8);
  params.baseline_px = json.value("baseline", 2.0);
  params.seed = seed;
  return scenes::render_scene(params, 0);
}

// The longest chain of bases.
constexpr int kMaxDepth = 8;

MadeStream make(const Recipes& recipes, const std::string& id, int depth);

// The base of the recipe with its edits applied.
MadeStream edited(const Recipes& recipes, const Recipe& recipe, int depth) {
  MadeStream made = make(recipes, recipe.stream.at("base"), depth + 1);
  for (const Json& edit : recipe.stream.at("edits")) edit_stream(made.bytes, edit);
  return made;
}

std::vector<uint8_t> stored_stream(const Json& json) {
  const auto file = io::map_file(json.at("file").get<std::string>());
  if (!file) throw TextError(file.error().message);
  return {file->bytes().begin(), file->bytes().end()};
}

std::vector<uint8_t> whole_stream(const Recipe& recipe, const std::string& kind) {
  if (kind == "encode") return encoded_stream(recipe.stream, recipe.seed);
  if (kind == "file") return stored_stream(recipe.stream);
  if (kind == "fields") return field_stream(recipe.stream, recipe.seed);
  if (kind == "random") {
    const Json limits = recipe.stream.value("limits", Json::object());
    return random_stream(recipe.seed, limits_from(limits));
  }
  throw TextError("\"" + kind + "\" is not a kind of stream");
}

MadeStream make(const Recipes& recipes, const std::string& id, int depth) {
  const auto recipe = recipes.find(id);
  if (recipe == recipes.end()) throw TextError("there is no recipe " + id);
  if (depth > kMaxDepth) throw TextError("its bases form a cycle");
  const auto kind = recipe->second.stream.at("kind").get<std::string>();
  if (kind == "edit") return edited(recipes, recipe->second, depth);
  MadeStream made;
  made.bytes = whole_stream(recipe->second, kind);
  made.header = parse_header(made.bytes).value();
  return made;
}

}  // namespace

std::vector<uint8_t> encoded_stream(const Json& json, uint64_t seed) {
  EncodeParams params = recipe_defaults();
  set_all(params, json.at("encode"), encode_setters(), "an option of encode");
  auto encoded = encode(scene_from(json.at("scene"), seed), params);
  if (!encoded) throw TextError("encode: " + encoded.error().message);
  return std::move(encoded->bytes);
}

MadeStream make_stream(const Recipes& recipes, const std::string& id) {
  try {
    return make(recipes, id, 0);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw TextError(id + ": " + error.what());
  }
}

}  // namespace hmlfc::vectors
