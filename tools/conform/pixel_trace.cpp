#include "conform/pixel_trace.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conform/report.hpp"
#include "io/json_text.hpp"

namespace hmlfc::conform {
namespace {

constexpr io::JsonLimits kLineLimits{"a stage", size_t{1} << 16, 4};

// The values of each name of a stage, in their order.
using Values = std::map<std::string, std::vector<int64_t>, std::less<>>;
// By the name of the stage and of its view.
using Stages = std::map<std::string, Values>;

std::string key_of(std::string_view stage, int64_t row, int64_t col) {
  return fmt::format("{} {},{}", stage, row, col);
}

std::string key_of(const FrameStage& stage) {
  return stage.view ? key_of(stage.name, stage.view->row, stage.view->col)
                    : key_of(stage.name, -1, -1);
}

void add_line(std::string_view line, Stages& stages) {
  const auto read = io::parse_json<Json>(
      {reinterpret_cast<const uint8_t*>(line.data()), line.size()}, kLineLimits);
  if (!read) return;
  try {
    const Json view = read->value("view", Json{{"row", -1}, {"col", -1}});
    Values& values =
        stages[key_of(read->at("stage").get<std::string>(), io::integer_at<int64_t>(view, "row"),
                      io::integer_at<int64_t>(view, "col"))];
    for (const Json& value : read->at("values")) {
      values[value.at("name").get<std::string>()].push_back(
          io::integer_at<int64_t>(value, "value"));
    }
  } catch (const Json::exception&) {
  }
}

Stages stages_of(std::string_view text) {
  Stages stages;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    add_line(text.substr(0, end), stages);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return stages;
}

// Where in words: "stage view (SMP-2), fx of view 0,1: 3 instead of 4".
std::string difference(const FrameStage& stage, const FrameValue& value, int64_t actual) {
  const std::string_view word = stage.name.substr(0, stage.name.find(' '));
  const std::string view =
      stage.view ? fmt::format(" of view {},{}", stage.view->row, stage.view->col) : std::string();
  return fmt::format("stage {} ({}), {}{}: {} instead of {}", word, value.clause, value.name, view,
                     actual, value.value);
}

}  // namespace

void PixelLines::add(void* lines, const hmlfc_dut_number* number) {
  auto& self = *static_cast<PixelLines*>(lines);
  const std::string stage = key_of(number->stage, number->view_row, number->view_col);
  const Json value{{"name", number->name}, {"value", number->value}};
  if (self.lines_.empty() || self.stage_ != stage) {
    self.stage_ = stage;
    std::string line = fmt::format("{{\"stage\": {}", Json(number->stage).dump());
    if (number->view_row >= 0) {
      line +=
          fmt::format(R"(, "view": {{"row": {}, "col": {}}})", number->view_row, number->view_col);
    }
    self.lines_.push_back(line + ", \"values\": [" + value.dump());
  } else {
    self.lines_.back() += ", " + value.dump();
  }
}

std::string PixelLines::text() const {
  std::string text = fmt::format(" {}", lines_.size());
  for (const std::string& line : lines_) text += "\n" + line + "]}";
  return text;
}

std::string first_wrong_number(const FrameTrace& expected, std::string_view actual) {
  const Stages stages = stages_of(actual);
  size_t compared = 0;
  for (const FrameStage& stage : expected.stages) {
    const auto found = stages.find(key_of(stage));
    if (found == stages.end()) continue;
    std::map<std::string_view, size_t> seen;
    for (const FrameValue& value : stage.values) {
      const auto values = found->second.find(value.name);
      const size_t number = seen[value.name]++;
      if (values == found->second.end() || number >= values->second.size()) continue;
      ++compared;
      if (values->second[number] != value.value) {
        return difference(stage, value, values->second[number]);
      }
    }
  }
  return compared == 0 ? "the renderer's trace has no number to compare"
                       : "all numbers of the pixel agree in the renderer's trace";
}

}  // namespace hmlfc::conform
