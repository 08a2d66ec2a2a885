#include "conform/command_renderer.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conform/command_decoder.hpp"
#include "conform/output_views.hpp"

namespace hmlfc::conform {
namespace {

bool has(const std::vector<std::string>& command, std::string_view place) {
  return std::ranges::any_of(
      command, [&](const std::string& word) { return word.find(place) != std::string::npos; });
}

}  // namespace

CommandRenderer::CommandRenderer(const Dut& dut, const ProcessLimits& limits,
                                 std::filesystem::path output)
    : dut_(dut), limits_(limits), output_(std::move(output)) {
  abilities_.frames = has(dut.frame, "{record}");
  abilities_.cameras = has(dut.frame, "{camera}");
  abilities_.maps = !dut.disparity.empty();
}

DutAnswer<hmlfc_dut_geometry> CommandRenderer::open(const std::filesystem::path& file) {
  file_ = file;
  geometry_ = geometry_of(file);
  return geometry_;
}

DutAnswer<void> CommandRenderer::run(const std::vector<std::string>& command, const Places& places,
                                     bool refused_camera) {
  const ProcessOutcome outcome = run_command(fill_in(command, places), limits_);
  messages_ = outcome.messages;
  if (outcome.value == 0) return {};
  std::string name;
  if (dut_.error_names) {
    name = refused_camera ? first_name(messages_, kCameraInputs)
                          : first_name(messages_, all_error_names());
  }
  if (name.empty()) name = to_string(outcome) + last_words(messages_);
  return tl::unexpected(std::move(name));
}

DutAnswer<DutFrame> CommandRenderer::frame(const vectors::FrameCase& request) {
  const vectors::FrameSum size = request.frame.value_or(vectors::FrameSum{});
  const auto levels = static_cast<int64_t>(geometry_.tree_height) + 1 - request.stop_level;
  const Places places{
      {"input", file_.string()},
      {"output", output_.string()},
      {"camera", vectors::camera_words(*request.camera)},
      {"record", request.record ? fmt::format("{}", fmt::join(*request.record, ",")) : ""},
      {"stop_level", std::to_string(request.stop_level)},
      {"levels", std::to_string(levels)}};
  if (auto done = run(dut_.frame, places, !request.record); !done) {
    return tl::unexpected(done.error());
  }
  if (size.sha256.empty()) return DutFrame{};  // an error should have come
  auto image = read_output_frame(output_, size.width, size.height, size.depth);
  if (!image) wrong_output(output_, image.error().message);
  return DutFrame{std::move(*image)};
}

DutAnswer<std::vector<BlockDisparity>> CommandRenderer::map(ViewPos view, size_t blocks) {
  const Places places{{"input", file_.string()},
                      {"output", output_.string()},
                      {"view_row", std::to_string(view.row)},
                      {"view_col", std::to_string(view.col)}};
  if (auto done = run(dut_.disparity, places, false); !done) return tl::unexpected(done.error());
  auto map = read_output_map(output_, blocks);
  if (!map) wrong_output(output_, map.error().message);
  return std::move(*map);
}

std::string CommandRenderer::take_messages() { return std::exchange(messages_, {}); }

}  // namespace hmlfc::conform
