#include "cli/render_trace.hpp"

#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/frame_trace.hpp>

#include "cli/arguments.hpp"

namespace hmlfc::cli {
namespace {

// The record as the first stage.
FrameStage record_stage(const FrameRecord& record) {
  FrameStage stage{"record", std::nullopt, {}};
  const auto names = frame_record_names();
  const auto values = frame_record_values(record);
  for (size_t k = 0; k < names.size(); ++k) stage.values.push_back({names[k], values[k], "REC-2"});
  return stage;
}

// A line for each run of values with one clause, cut where it gets long.
std::string stage_text(const FrameStage& stage) {
  constexpr size_t kColumns = 100;
  std::string text(stage.name);
  if (stage.view) text += fmt::format(" {},{}", stage.view->row, stage.view->col);
  std::string line;
  std::string_view clause;
  for (const FrameValue& value : stage.values) {
    const std::string part = fmt::format("{} = {}", value.name, value.value);
    if (value.clause != clause || line.size() + part.size() > kColumns) {
      text += line + "\n";
      clause = value.clause;
      line = fmt::format("  {:<6} {}", clause, part);
    } else {
      line += ", " + part;
    }
  }
  return text + line + "\n";
}

Json stage_json(const FrameStage& stage) {
  Json json{{"stage", stage.name}};
  if (stage.view) json["view"] = {{"row", stage.view->row}, {"col", stage.view->col}};
  Json& values = json["values"] = Json::array();
  for (const FrameValue& value : stage.values) {
    values.push_back({{"name", value.name}, {"value", value.value}, {"clause", value.clause}});
  }
  return json;
}

std::string trace_text(FramePixel pixel, const FrameRecord& record, const FrameTrace& trace) {
  std::string text = fmt::format("Pixel x {}, y {} of the frame: R {}, G {}, B {}\n\n", pixel.x,
                                 pixel.y, trace.sample[0], trace.sample[1], trace.sample[2]);
  text += stage_text(record_stage(record));
  for (const FrameStage& stage : trace.stages) text += stage_text(stage);
  return text;
}

FrameTrace trace_of(const StreamFile& file, const FrameRecord& record, int stop_level,
                    FramePixel pixel) {
  if (pixel.x >= static_cast<uint32_t>(record.frame_width) ||
      pixel.y >= static_cast<uint32_t>(record.frame_height)) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("--trace {},{}: the frame has {} x {} pixels", pixel.x, pixel.y,
                              record.frame_width, record.frame_height));
  }
  return file.value(frame_trace(file.decoder(), record, stop_level, pixel.x, pixel.y));
}

}  // namespace

CLI::Option* add_trace(CLI::App& app, std::optional<FramePixel>& pixel) {
  return add_numbers<2>(app, "--trace", "X,Y", ',', "x,y, such as 120,80",
                        "Show how this pixel comes about, and write no frame",
                        [&pixel](const auto& n) {
                          pixel = FramePixel{n[0], n[1]};
                        });
}

Json trace_json(const StreamFile& file, const FrameRecord& record, int stop_level,
                FramePixel pixel) {
  const FrameTrace trace = trace_of(file, record, stop_level, pixel);
  Json stages{stage_json(record_stage(record))};
  for (const FrameStage& stage : trace.stages) stages.push_back(stage_json(stage));
  return {{"pixel", {{"x", pixel.x}, {"y", pixel.y}}},
          {"stages", std::move(stages)},
          {"sample", trace.sample}};
}

void print_trace(const StreamFile& file, const FrameRecord& record, int stop_level,
                 FramePixel pixel, bool json) {
  if (json) {
    print_json(trace_json(file, record, stop_level, pixel));
  } else {
    print(trace_text(pixel, record, trace_of(file, record, stop_level, pixel)));
  }
}

}  // namespace hmlfc::cli
