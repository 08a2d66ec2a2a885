#include "cli/block_report.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include <hmlfc/stream_info.hpp>

namespace hmlfc::cli {

namespace {

Json field_json(const TracedWalk& walk, const FieldRecord& field, const StreamHeader& header) {
  Json json{{"section", section_name(field.section)},
            {"byte", field.bit >> 3},
            {"bit", field.bit & 7},
            {"bits", field.bits},
            {"name", field.name},
            {"clause", field.clause},
            {"value", vectors::value_json(field)}};
  const std::string unit = unit_of(walk, field, header);
  if (!unit.empty()) json["unit"] = unit;
  return json;
}

Json fields_json(const TracedWalk& walk, const StreamHeader& header) {
  Json fields = Json::array();
  for (const FieldRecord& field : walk.fields) fields.push_back(field_json(walk, field, header));
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

Json vector_json(const VectorRecord& vector) {
  return {{"image", {{"row", vector.image_row}, {"col", vector.image_col}}},
          {"x", vector.x / 8.0},
          {"y", vector.y / 8.0},
          {"unit", "samples"},
          {"clause", vector.clause}};
}

Json level_json(const TracedLevel& level, const StreamHeader& header) {
  const ImageInfo image =
      image_info(header, level.site.level, level.site.image_row, level.site.image_col);
  Json json;
  json["level"] = level.site.level;
  json["image"] = place_json(level.site);
  json["kind"] = image_kind_name(image.kind);
  json["state"] = image.kind == ImageKind::kKey ? Json(nullptr) : Json(state_name(level.state()));
  if (const TracedWalk* motion = level.walk(TileKind::kMotion)) {
    json["motion_fields"] = fields_json(*motion, header);
  }
  if (const TracedWalk* disparity = level.walk(TileKind::kDisparity)) {
    json["disparity"] = {{"image", place_json(disparity->site)},
                         {"fields", fields_json(*disparity, header)}};
  }
  const TracedWalk* own = level.own_walk();
  json["fields"] = own == nullptr ? Json::array() : fields_json(*own, header);
  Json& vectors = json["vectors"] = Json::array();
  for (const VectorRecord& vector : level.vectors) vectors.push_back(vector_json(vector));
  Json& references = json["reference_blocks"] = Json::array();
  for (const TracedWalk& walk : level.walks) {
    if (!level.is_reference(walk)) continue;
    references.push_back({{"image", place_json(walk.site)},
                          {"block", {walk.site.bx, walk.site.by}},
                          {"fields", fields_json(walk, header)}});
  }
  Json& stages = json["stages"] = Json::object();
  for (const RecordedStage& stage : level.stages) {
    stages[stage.stage] = {{"clause", stage.clause},
                           {"values", rows_of(stage.values, header.block_size())}};
  }
  return json;
}

}  // namespace

std::optional<int64_t> TracedWalk::last_value(std::string_view name) const {
  std::optional<int64_t> value;
  for (const FieldRecord& field : fields) {
    if (field.name == name) value = field.value;
  }
  return value;
}

std::optional<unsigned> TracedWalk::level_code() const {
  const auto base = last_value("level_base");
  if (!base) return std::nullopt;
  return static_cast<unsigned>(*base + last_value("level_delta").value_or(0));
}

std::optional<unsigned> TracedWalk::step_code() const {
  const auto base = last_value("step_base");
  if (!base) return std::nullopt;
  return static_cast<unsigned>(*base + last_value("step_delta").value_or(0));
}

const TracedWalk* TracedLevel::own_walk() const {
  const auto found = std::ranges::find(walks, site, &TracedWalk::site);
  return found == walks.end() ? nullptr : &*found;
}

const TracedWalk* TracedLevel::walk(TileKind kind) const {
  const auto found =
      std::ranges::find(walks, kind, [](const TracedWalk& walk) { return walk.site.tile; });
  return found == walks.end() ? nullptr : &*found;
}

bool TracedLevel::is_reference(const TracedWalk& walk) const {
  return walk.site.tile == TileKind::kResidual && walk.site != site;
}

const RecordedStage* TracedLevel::stage(std::string_view name) const {
  const auto found = std::ranges::find(stages, name, &RecordedStage::stage);
  return found == stages.end() ? nullptr : &*found;
}

BlockState TracedLevel::state() const {
  const bool residual = stage("residual") != nullptr;
  if (stage("reference") != nullptr) {
    return residual ? BlockState::kMotionResidual : BlockState::kMotion;
  }
  return residual ? BlockState::kResidual : BlockState::kZero;
}

TracedLevel& BlockTrace::level_of(const BlockSite& site) {
  if (levels_.empty() || levels_.back().site.level != site.level) {
    BlockSite own = site;
    own.tile = TileKind::kResidual;
    levels_.push_back({own, {}, {}, {}});
  }
  return levels_.back();
}

void BlockTrace::on_field(const FieldRecord& record) {
  TracedLevel& level = level_of(record.site);
  if (level.walks.empty() || level.walks.back().site != record.site) {
    level.walks.push_back({record.site, {}});
  }
  level.walks.back().fields.push_back(record);
}

void BlockTrace::on_stage(const StageRecord& record) {
  level_of(record.site).stages.push_back(vectors::recorded(record));
}

Json to_json(const BlockReport& report) {
  Json json;
  json["view"] = {{"row", report.block.view.row}, {"col", report.block.view.col}};
  json["plane"] = plane_name(report.block.plane);
  json["block"] = {report.block.bx, report.block.by};
  Json& levels = json["levels"] = Json::array();
  for (const TracedLevel& level : report.trace.levels()) {
    levels.push_back(level_json(level, report.header));
  }
  json["cost"] = {{"walks", report.counts.walks},
                  {"fields", report.counts.fields},
                  {"bits", report.counts.bits},
                  {"bytes", (report.counts.bits + 7) / 8},
                  {"steps", report.counts.steps}};
  return json;
}

}  // namespace hmlfc::cli
