#include "view/stream_facts.hpp"

#include <nlohmann/json.hpp>

#include <hmlfc/camera.hpp>
#include <hmlfc/version.hpp>

#include "cli/camera_path.hpp"
#include "cli/stream_report.hpp"
#include "conform/block_commands.hpp"
#include "view/image_bytes.hpp"

namespace hmlfc::view {

using cli::Json;

namespace {

// Disparities of the middle view in pixels a column, or null.
Json disparities(const cli::StreamFile& file) {
  const StreamHeader& header = file.header();
  const auto map = disparity_map(file.decoder(), {(header.rows - 1) / 2, (header.cols - 1) / 2});
  file.check_readable();
  if (!map) return nullptr;
  const auto range = map ? cli::known_range(*map) : std::nullopt;
  return range ? Json(*range) : Json(nullptr);
}

Json counts_json(const std::map<uint32_t, uint64_t>& counts) {
  Json json = Json::object();
  for (const auto& [number, blocks] : counts) json[std::to_string(number)] = blocks;
  return json;
}

Json images_json(const ImageBytes& bytes) {
  Json levels = Json::array();
  for (const LevelBytes& level : bytes.levels) {
    const bool few = level.images.size() <= io::kMostListedImages;
    levels.push_back({{"level", level.level},
                      {"rows", level.rows},
                      {"cols", level.cols},
                      {"images", few ? Json(level.images) : Json(nullptr)},
                      {"planes", level.planes},
                      {"key_planes", level.key_planes},
                      {"motion_tiles", level.motion_tiles}});
  }
  return {{"levels", std::move(levels)},
          {"level_counts", counts_json(bytes.level_counts)},
          {"steps", counts_json(bytes.steps)}};
}

}  // namespace

Json stream_facts(const OpenStream& stream) {
  Json json{{"name", stream.path().filename().string()},
            {"file", conform::shell_word(stream.path().string())},
            {"version", HMLFC_VERSION},
            {"error", stream.error()},
            {"warning", stream.warning()},
            {"original", stream.original() != nullptr}};
  if (!stream.error().empty()) return json;
  const cli::StreamFile& file = stream.for_blocks();
  const StreamHeader& header = file.header();
  json["bytes"] = file.size();
  json["rows"] = header.rows;
  json["cols"] = header.cols;
  json["width"] = header.width;
  json["height"] = header.height;
  json["depth"] = header.depth;
  json["block"] = header.block_size();
  if (stream.twin() != nullptr) json["twin"] = stream_facts(*stream.twin());
  json["coding"] = cli::describe_coding(header);
  json["tools"] = io::tools_of(header);
  json["tree_height"] = header.tree_height;
  json["cluster"] = {header.cluster_rows, header.cluster_cols};
  json["levels"] = io::levels_json(header);
  json["geometry"] = geometry_name(suitable_geometry(header));
  json["disparity"] = disparities(file);
  return json;
}

Json stream_totals(const OpenStream& stream) {
  const cli::StreamFile& file = stream.for_blocks();
  const io::StreamReport report = report_on(file);
  Json json = report_json(report);
  add_structure(report, json);
  json["images"] = images_json(file.value(image_bytes(file.decoder())));
  return json;
}

}  // namespace hmlfc::view
