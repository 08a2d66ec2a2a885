#include "vectors/stream_recipe.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include <hmlfc/encoder.hpp>

#include "scenes/scene.hpp"
#include "syntax/header.hpp"
#include "vectors/field_stream.hpp"
#include "vectors/random_stream.hpp"
#include "vectors/stream_edit.hpp"

namespace hmlfc::vectors {

namespace {

using Setter = std::function<void(StreamHeader&, const Json&)>;

// A field that is a number in `StreamHeader` and in the recipe.
template <class T>
Setter number(T StreamHeader::*member) {
  return [member](StreamHeader& header, const Json& json) { header.*member = json.get<T>(); };
}

void set_features(StreamHeader& header, const Json& json) {
  header.profile = Profile::kExtended;
  for (const Json& name : json) {
    unsigned feature = 0;
    while (feature < kFeatureCount && name != feature_name(static_cast<Feature>(feature))) {
      ++feature;
    }
    if (feature == kFeatureCount) throw TextError(name.dump() + " is no feature of EXT-1");
    header.feature_flags |= 1u << feature;
  }
}

void set_chroma(StreamHeader& header, const Json& json) {
  if (json != "420" && json != "444") throw TextError("chroma_format is \"420\" or \"444\"");
  header.chroma_format = json == "444" ? ChromaFormat::k444 : ChromaFormat::k420;
}

void set_levels(StreamHeader& header, const Json& json) {
  for (const Json& level : json) {
    header.levels.push_back(
        {level.at(0), level.at(1), level.size() > 2 ? level.at(2).get<uint8_t>() : uint8_t{0}});
  }
}

const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> all{
      {"features", set_features},
      {"rows", number(&StreamHeader::rows)},
      {"cols", number(&StreamHeader::cols)},
      {"width", number(&StreamHeader::width)},
      {"height", number(&StreamHeader::height)},
      {"depth", number(&StreamHeader::depth)},
      {"chroma_format", set_chroma},
      {"block_log2", number(&StreamHeader::block_log2)},
      {"window", number(&StreamHeader::window)},
      {"cluster_rows", number(&StreamHeader::cluster_rows)},
      {"cluster_cols", number(&StreamHeader::cluster_cols)},
      {"tree_height", number(&StreamHeader::tree_height)},
      {"vector_precision", number(&StreamHeader::vector_precision)},
      {"disparity_precision", number(&StreamHeader::disparity_precision)},
      {"motion_tile_log2", number(&StreamHeader::motion_tile_log2)},
      {"disparity_grid_log2", number(&StreamHeader::disparity_grid_log2)},
      {"row_scale", number(&StreamHeader::row_scale)},
      {"levels", set_levels},
  };
  return all;
}

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

StreamHeader header_from(const Json& json) {
  StreamHeader header;
  header.width = 16;
  header.height = 16;
  for (const auto& [key, value] : json.items()) {
    const auto setter = setters().find(key);
    if (setter == setters().end()) throw TextError("\"" + key + "\" is no field of a header");
    setter->second(header, value);
  }
  const size_t levels = static_cast<size_t>(header.tree_height) + 1;
  if (header.levels.empty()) header.levels.push_back({});
  header.levels.resize(levels, header.levels.back());
  if (!header.has(Feature::kLevelKeys)) {
    for (LevelEntry& level : header.levels) level.key_references = 0;
  }
  header.levels.back().key_references = 0;
  if (const auto ok = check_fields(header); !ok) {
    throw TextError("header: " + to_string(ok.error()));
  }
  return header;
}

std::vector<std::string> header_flags(const StreamHeader& header) {
  std::vector<std::string> flags;
  for (unsigned i = 0; i < kFeatureCount; ++i) {
    const auto feature = static_cast<Feature>(i);
    if (header.has(feature)) flags.emplace_back(feature_name(feature));
  }
  flags.emplace_back(header.chroma_format == ChromaFormat::k444 ? "chroma444" : "chroma420");
  flags.push_back("depth" + std::to_string(header.depth));
  flags.push_back("block" + std::to_string(header.block_size()));
  if (header.tree_height > 0) flags.emplace_back("tree");
  const bool groups = std::any_of(header.levels.begin(), header.levels.end(), [](LevelEntry level) {
    return level.ref_rows > 1 || level.ref_cols > 1;
  });
  if (groups) flags.emplace_back("predictive");
  return flags;
}

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

MadeStream make_stream(const Recipes& recipes, const std::string& id) {
  try {
    return make(recipes, id, 0);
  } catch (const std::exception& error) {
    throw TextError(id + ": " + error.what());
  }
}

}  // namespace hmlfc::vectors
