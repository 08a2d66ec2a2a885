#include "conform/stage_trace.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conform/report.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {
namespace {

using vectors::RecordedStage;

constexpr io::JsonLimits kStageLimits{"a stage", size_t{1} << 20, 2};

std::optional<RecordedStage> parse_line(std::string_view line) {
  if (line.empty() || line.front() != '{') return std::nullopt;
  const auto read = io::parse_json<Json>(
      {reinterpret_cast<const uint8_t*>(line.data()), line.size()}, kStageLimits);
  if (!read) return std::nullopt;
  const Json& json = *read;
  try {
    if (json.at("record").get<std::string>() != "stage") return std::nullopt;
    const auto plane = std::ranges::find(kPlanes, json.at("plane").get<std::string>(), plane_name);
    if (plane == kPlanes.end()) return std::nullopt;
    const Json& image = json.at("image");
    const Json& block = json.at("block");
    return RecordedStage{{io::integer_at<int>(json, "level"), io::integer_at<uint32_t>(image, 0U),
                          io::integer_at<uint32_t>(image, 1U), *plane,
                          io::integer_at<uint32_t>(block, 0U), io::integer_at<uint32_t>(block, 1U)},
                         json.at("stage"),
                         {},
                         io::integers_at<int32_t>(json, "values")};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string stage_line(const hmlfc_dut_stage& stage) {
  const Json json{{"record", "stage"},
                  {"level", stage.level},
                  {"image", {stage.image_row, stage.image_col}},
                  {"plane", plane_name(static_cast<Plane>(stage.plane))},
                  {"block", {stage.block_x, stage.block_y}},
                  {"stage", stage.stage},
                  {"values", std::vector<int32_t>(stage.values, stage.values + stage.count)}};
  return json.dump();
}

std::vector<RecordedStage> parse_stages(std::string_view text) {
  std::vector<RecordedStage> stages;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    if (auto stage = parse_line(text.substr(0, end))) stages.push_back(std::move(*stage));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return stages;
}

std::optional<std::string> first_wrong_value(const Decoder& decoder, Plane plane, uint32_t bx,
                                             uint32_t by, std::span<const int32_t> expected,
                                             std::span<const int32_t> actual) {
  const uint32_t b = decoder.header().block_size();
  const PlaneSize size = decoder.plane_size(plane);
  for (uint32_t i = 0; i < expected.size(); ++i) {
    const uint32_t x = i % b;
    const uint32_t y = i / b;
    if (bx * b + x >= size.width || by * b + y >= size.height) continue;
    if (i < actual.size() && actual[i] == expected[i]) continue;
    return fmt::format("value {} (x {}, y {}) is {} instead of {}", i, x, y,
                       i < actual.size() ? std::to_string(actual[i]) : "missing", expected[i]);
  }
  return std::nullopt;
}

std::optional<std::string> first_wrong_stage(const Decoder& decoder, const BlockAddress& block,
                                             int stop_level,
                                             const std::vector<RecordedStage>& actual) {
  vectors::BlockRecorder recorder;
  static_cast<void>(decoder.decode_block(block, {.stop_level = stop_level, .trace = &recorder}));
  for (const auto& record : recorder.records) {
    const auto* golden = std::get_if<RecordedStage>(&record);
    if (golden == nullptr) continue;
    const auto& [site, stage, clause, values] = *golden;
    const auto found = std::ranges::find_if(actual, [&](const RecordedStage& other) {
      return other.stage == golden->stage && other.site == golden->site;
    });
    if (found == actual.end()) continue;
    const auto what =
        first_wrong_value(decoder, site.plane, site.bx, site.by, values, found->values);
    if (!what) continue;
    return fmt::format("stage {} ({}) at level {} image {},{} plane {} block {},{}: {}", stage,
                       clause, site.level, site.image_row, site.image_col, plane_name(site.plane),
                       site.bx, site.by, *what);
  }
  return std::nullopt;
}

}  // namespace hmlfc::conform
