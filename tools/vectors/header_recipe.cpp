#include "vectors/header_recipe.hpp"

#include <algorithm>

#include "syntax/header.hpp"

namespace hmlfc::vectors {
namespace {

void set_features(StreamHeader& header, const Json& json) {
  header.profile = Profile::kExtended;
  for (const Json& name : json) {
    unsigned feature = 0;
    while (feature < kFeatureCount && name != feature_name(static_cast<Feature>(feature))) {
      ++feature;
    }
    if (feature == kFeatureCount) throw TextError(name.dump() + " is not a feature of EXT-1");
    header.feature_flags |= 1u << feature;
  }
}

void set_levels(StreamHeader& header, const Json& json) {
  for (const Json& level : json) {
    header.levels.push_back(
        {level.at(0), level.at(1), level.size() > 2 ? level.at(2).get<uint8_t>() : uint8_t{0}});
  }
}

const Setters<StreamHeader>& header_setters() {
  static const Setters<StreamHeader> all{
      {"features", set_features},
      {"rows", number(&StreamHeader::rows)},
      {"cols", number(&StreamHeader::cols)},
      {"width", number(&StreamHeader::width)},
      {"height", number(&StreamHeader::height)},
      {"depth", number(&StreamHeader::depth)},
      {"chroma_format", word(&StreamHeader::chroma_format, chroma_formats())},
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
  set_all(header, json, header_setters(), "a field of a header");
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
