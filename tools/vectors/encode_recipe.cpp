#include "vectors/encode_recipe.hpp"

#include <functional>
#include <map>
#include <string>

#include <hmlfc/encoder.hpp>

#include "scenes/scene.hpp"

namespace hmlfc::vectors {
namespace {

using Setter = std::function<void(EncodeParams&, const Json&)>;

// Sets what `target`, a function, returns of the parameters.
template <class T, class Target>
Setter number(const Target& target) {
  return [target](EncodeParams& params, const Json& json) { target(params) = json.get<T>(); };
}

template <class Target, class T>
Setter word(const Target& target, std::map<std::string, T> words) {
  return [target, words = std::move(words)](EncodeParams& params, const Json& json) {
    const auto found = words.find(json.get<std::string>());
    if (found == words.end()) throw TextError(json.dump() + " is no value of an option to encode");
    target(params) = found->second;
  };
}

const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> all{
      {"profile", word(
                      [](EncodeParams & p) -> auto& { return p.profile; },
                      std::map<std::string, Profile>{{"main", Profile::kMain},
                                                     {"extended", Profile::kExtended}})},
      {"method", word(
                     [](EncodeParams & p) -> auto& { return p.method; },
                     std::map<std::string, Method>{
                         {"hmlfc", Method::kHmlfc}, {"rlfc", Method::kRlfc}, {"mc", Method::kMc}})},
      {"preset",
       word(
           [](EncodeParams & p) -> auto& { return p.extended.preset; },
           std::map<std::string, Preset>{
               {"fast", Preset::kFast}, {"medium", Preset::kMedium}, {"slow", Preset::kSlow}})},
      {"chroma", word(
                     [](EncodeParams & p) -> auto& { return p.chroma; },
                     std::map<std::string, ChromaFormat>{{"420", ChromaFormat::k420},
                                                         {"444", ChromaFormat::k444}})},
      {"cluster_rows", number<uint32_t>([](EncodeParams & p) -> auto& { return p.cluster_rows; })},
      {"cluster_cols", number<uint32_t>([](EncodeParams & p) -> auto& { return p.cluster_cols; })},
      {"tree_height", number<int>([](EncodeParams & p) -> auto& { return p.tree_height; })},
      {"block_size", number<unsigned>([](EncodeParams & p) -> auto& { return p.block_size; })},
      {"window", number<int>([](EncodeParams & p) -> auto& { return p.window; })},
      {"ref_rows", number<uint32_t>([](EncodeParams & p) -> auto& { return p.ref_rows; })},
      {"ref_cols", number<uint32_t>([](EncodeParams & p) -> auto& { return p.ref_cols; })},
      {"threshold_ref",
       number<uint32_t>([](EncodeParams & p) -> auto& { return p.main.threshold_ref; })},
      {"threshold_pred",
       number<uint32_t>([](EncodeParams & p) -> auto& { return p.main.threshold_pred; })},
      {"quality", number<double>([](EncodeParams & p) -> auto& { return p.extended.quality; })},
      {"lossless", number<bool>([](EncodeParams & p) -> auto& { return p.lossless; })},
  };
  return all;
}

// What a recipe leaves out: fixed, whatever the defaults of the encoder become.
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
  if (!scene) throw TextError("\"" + name + "\" is no scene");
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

}  // namespace

std::vector<uint8_t> encoded_stream(const Json& json, uint64_t seed) {
  EncodeParams params = recipe_defaults();
  for (const auto& [key, value] : json.at("encode").items()) {
    const auto setter = setters().find(key);
    if (setter == setters().end()) throw TextError("\"" + key + "\" is no option to encode");
    setter->second(params, value);
  }
  auto encoded = encode(scene_from(json.at("scene"), seed), params);
  if (!encoded) throw TextError("encode: " + encoded.error().message);
  return std::move(encoded->bytes);
}

}  // namespace hmlfc::vectors
