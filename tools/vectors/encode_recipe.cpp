#include "vectors/encode_recipe.hpp"

#include <functional>
#include <map>
#include <string>

#include <hmlfc/encoder.hpp>

#include "scenes/scene.hpp"

namespace hmlfc::vectors {
namespace {

using Setter = std::function<void(EncodeParams&, const Json&)>;

template <class T>
Setter number(T EncodeParams::*member) {
  return [member](EncodeParams& params, const Json& json) { params.*member = json.get<T>(); };
}

template <class T>
Setter word(T EncodeParams::*member, std::map<std::string, T> words) {
  return [member, words = std::move(words)](EncodeParams& params, const Json& json) {
    const auto found = words.find(json.get<std::string>());
    if (found == words.end()) throw TextError(json.dump() + " is no value of an option to encode");
    params.*member = found->second;
  };
}

const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> all{
      {"profile",
       word(&EncodeParams::profile, {{"main", Profile::kMain}, {"extended", Profile::kExtended}})},
      {"method", word(&EncodeParams::method,
                      {{"hmlfc", Method::kHmlfc}, {"rlfc", Method::kRlfc}, {"mc", Method::kMc}})},
      {"preset",
       word(&EncodeParams::preset,
            {{"fast", Preset::kFast}, {"medium", Preset::kMedium}, {"slow", Preset::kSlow}})},
      {"chroma",
       word(&EncodeParams::chroma, {{"420", ChromaFormat::k420}, {"444", ChromaFormat::k444}})},
      {"cluster_rows", number(&EncodeParams::cluster_rows)},
      {"cluster_cols", number(&EncodeParams::cluster_cols)},
      {"tree_height", number(&EncodeParams::tree_height)},
      {"block_size", number(&EncodeParams::block_size)},
      {"window", number(&EncodeParams::window)},
      {"ref_rows", number(&EncodeParams::ref_rows)},
      {"ref_cols", number(&EncodeParams::ref_cols)},
      {"threshold_ref", number(&EncodeParams::threshold_ref)},
      {"threshold_pred", number(&EncodeParams::threshold_pred)},
      {"quality", number(&EncodeParams::quality)},
      {"lossless", number(&EncodeParams::lossless)},
  };
  return all;
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
  EncodeParams params;
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
