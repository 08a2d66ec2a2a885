#include "vectors/header_recipe.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include "syntax/header.hpp"

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

}  // namespace hmlfc::vectors
