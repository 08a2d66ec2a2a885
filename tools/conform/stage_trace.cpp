#include "conform/stage_trace.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conform/report.hpp"

namespace hmlfc::conform {
namespace {

class StageSink final : public TraceSink {
 public:
  void on_field(const FieldRecord&) override {}

  void on_stage(const StageRecord& record) override {
    const BlockSite& site = record.site;
    Stage stage{std::string(record.stage),
                static_cast<uint32_t>(site.level),
                site.image_row,
                site.image_col,
                site.plane,
                site.bx,
                site.by,
                {record.values.begin(), record.values.end()}};
    stages.emplace_back(std::move(stage), std::string(record.clause));
  }

  std::vector<std::pair<Stage, std::string>> stages;
};

std::optional<Stage> parse_line(std::string_view line) {
  if (line.empty() || line.front() != '{') return std::nullopt;
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || json.value("record", "") != "stage") return std::nullopt;
  try {
    const auto plane = std::ranges::find(kPlanes, json.at("plane").get<std::string>(), plane_name);
    if (plane == kPlanes.end()) return std::nullopt;
    const Json& image = json.at("image");
    const Json& block = json.at("block");
    return Stage{json.at("stage"), json.at("level"), image.at(0), image.at(1),
                 *plane,           block.at(0),      block.at(1), json.at("values")};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string stage_line(const hmlfc_dut_stage& stage) {
  Json json;
  json["record"] = "stage";
  json["level"] = stage.level;
  json["image"] = {stage.image_row, stage.image_col};
  json["plane"] = plane_name(static_cast<Plane>(stage.plane));
  json["block"] = {stage.block_x, stage.block_y};
  json["stage"] = stage.stage;
  json["values"] = std::vector<int32_t>(stage.values, stage.values + stage.count);
  return json.dump();
}

std::vector<Stage> parse_stages(std::string_view text) {
  std::vector<Stage> stages;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    if (auto stage = parse_line(text.substr(0, end))) stages.push_back(std::move(*stage));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return stages;
}

std::vector<std::pair<Stage, std::string>> golden_stages(const Decoder& decoder,
                                                         const BlockAddress& block) {
  StageSink sink;
  // An error ends the trace; what came before it is of use.
  (void)decoder.decode_block(block, {.trace = &sink});
  return std::move(sink.stages);
}

std::optional<std::string> first_wrong_stage(const Decoder& decoder, const BlockAddress& block,
                                             const std::vector<Stage>& actual) {
  const uint32_t b = decoder.header().block_size();
  for (const auto& [stage, clause] : golden_stages(decoder, block)) {
    const auto same = [&stage = stage](const Stage& other) { return other.same_place(stage); };
    const auto found = std::ranges::find_if(actual, same);
    if (found == actual.end()) continue;
    const PlaneSize size = decoder.plane_size(stage.plane);
    for (uint32_t i = 0; i < stage.values.size(); ++i) {
      const uint32_t x = i % b;
      const uint32_t y = i / b;
      if (stage.block_x * b + x >= size.width || stage.block_y * b + y >= size.height) continue;
      if (i < found->values.size() && found->values[i] == stage.values[i]) continue;
      const std::string is =
          i < found->values.size() ? std::to_string(found->values[i]) : "missing";
      return fmt::format(
          "stage {} ({}) at level {} image {},{} plane {} block {},{}: value {} (x {}, y {}) is {} "
          "instead of {}",
          stage.stage, clause, stage.level, stage.image_row, stage.image_col,
          plane_name(stage.plane), stage.block_x, stage.block_y, i, x, y, is, stage.values[i]);
    }
  }
  return std::nullopt;
}

}  // namespace hmlfc::conform
