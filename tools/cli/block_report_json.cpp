#include "cli/block_report_json.hpp"

#include <utility>

#include "syntax/geometry.hpp"

namespace hmlfc::cli {
namespace {

Json field_json(const TracedField& field) {
  Json json;
  json["section"] = section_name(field.section);
  json["byte"] = field.bit >> 3;
  json["bit"] = field.bit & 7;
  json["bits"] = field.bits;
  json["name"] = field.name;
  json["clause"] = field.clause;
  if (field.bits == 64) {
    json["value"] = static_cast<uint64_t>(field.value);
  } else {
    json["value"] = field.value;
  }
  return json;
}

Json fields_json(const TracedWalk& walk) {
  Json fields = Json::array();
  for (const TracedField& field : walk.fields) fields.push_back(field_json(field));
  return fields;
}

Json place_json(const BlockSite& site) {
  return {{"row", site.image_row}, {"col", site.image_col}};
}

Json rows_of(const std::vector<int32_t>& values, size_t width) {
  Json rows = Json::array();
  for (size_t at = 0; at < values.size(); at += width) {
    Json row = Json::array();
    for (size_t x = 0; x < width; ++x) row.push_back(values[at + x]);
    rows.push_back(std::move(row));
  }
  return rows;
}

Json level_json(const TracedLevel& level, const Geometry& geometry) {
  const ImagePos at{level.site.image_row, level.site.image_col};
  const bool key = geometry.is_key(level.site.level, at);
  Json json;
  json["level"] = level.site.level;
  json["image"] = place_json(level.site);
  json["kind"] = key                                           ? "key"
                 : geometry.is_reference(level.site.level, at) ? "reference"
                                                               : "predictive";
  json["state"] = key ? Json(nullptr) : Json(state_name(level.state()));
  if (const TracedWalk* motion = level.walk(TileKind::kMotion)) {
    json["motion_fields"] = fields_json(*motion);
  }
  if (const TracedWalk* disparity = level.walk(TileKind::kDisparity)) {
    json["disparity"] = {{"image", place_json(disparity->site)},
                         {"fields", fields_json(*disparity)}};
  }
  const TracedWalk* own = level.own_walk();
  json["fields"] = own == nullptr ? Json::array() : fields_json(*own);
  Json& references = json["reference_blocks"] = Json::array();
  for (const TracedWalk& walk : level.walks) {
    if (!level.is_reference(walk)) continue;
    references.push_back({{"image", place_json(walk.site)},
                          {"block", {walk.site.bx, walk.site.by}},
                          {"fields", fields_json(walk)}});
  }
  Json& stages = json["stages"] = Json::object();
  for (const TracedStage& stage : level.stages) {
    stages[stage.name] = {{"clause", stage.clause},
                          {"values", rows_of(stage.values, geometry.block_size())}};
  }
  return json;
}

}  // namespace

Json to_json(const BlockReport& report) {
  const Geometry geometry(report.header);
  Json json;
  json["view"] = {{"row", report.block.view.row}, {"col", report.block.view.col}};
  json["plane"] = plane_name(report.block.plane);
  json["block"] = {report.block.bx, report.block.by};
  Json& levels = json["levels"] = Json::array();
  for (const TracedLevel& level : report.trace.levels()) {
    levels.push_back(level_json(level, geometry));
  }
  json["cost"] = {{"walks", report.counts.walks},
                  {"fields", report.counts.fields},
                  {"bits", report.counts.bits},
                  {"bytes", (report.counts.bits + 7) / 8},
                  {"steps", report.counts.steps}};
  return json;
}

}  // namespace hmlfc::cli
