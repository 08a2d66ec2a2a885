#include "conform/command_decoder.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <hmlfc/dut.hpp>
#include <hmlfc/stream_info.hpp>

#include "conform/output_views.hpp"
#include "io/files.hpp"

namespace hmlfc::conform {
namespace {

// Exit statuses of a shell or env for a program that does not exist.
constexpr int kNotExecutable = 126;
constexpr int kNotFound = 127;

// Throws for outcomes that fail any vector: a timeout, a crash, a program that is missing.
void check_ended(const ProcessOutcome& outcome) {
  const std::string last = last_words(outcome.messages);
  if (outcome.end == ProcessEnd::kTimeout) {
    throw DutFailure{Status::kTimeout, to_string(outcome), outcome.messages};
  }
  if (outcome.end != ProcessEnd::kExit || outcome.value == kNotExecutable ||
      outcome.value == kNotFound) {
    throw DutFailure{Status::kError, to_string(outcome) + last, outcome.messages};
  }
  if (outcome.value == kExitSkipped) {
    throw DutFailure{Status::kSkipped, "the decoder cannot run here" + last, outcome.messages};
  }
}

}  // namespace

std::string first_name(std::string_view messages, std::span<const std::string_view> names) {
  size_t end = 0;
  for (size_t at = 0; (at = messages.find_first_of(kWordCharacters, end)) != messages.npos;) {
    end = std::min(messages.find_first_not_of(kWordCharacters, at), messages.size());
    const std::string_view word = messages.substr(at, end - at);
    if (std::ranges::find(names, word) != names.end()) return std::string(word);
  }
  return {};
}

std::vector<std::string_view> all_error_names() {
  std::vector<std::string_view> names;
  for (int code = 1; code < kErrorCodeCount; ++code) {
    names.push_back(error_name(static_cast<ErrorCode>(code)));
  }
  return names;
}

ProcessOutcome run_command(const std::vector<std::string>& command, const ProcessLimits& limits) {
  ProcessOutcome outcome = run_process(command, limits);
  check_ended(outcome);
  return outcome;
}

void wrong_output(const std::filesystem::path& output, std::string what) {
  const std::string above = output.parent_path().string() + "/";
  const size_t at = what.find(above);
  if (at != what.npos) what.erase(at, above.size());
  throw DutFailure{Status::kFail, "wrong output: " + what};
}

hmlfc_dut_geometry geometry_of(const std::filesystem::path& file) {
  const auto mapped = io::map_file(file);
  if (!mapped) return {};
  const auto header = parse_header(mapped->bytes());
  return header ? dut_geometry(*header) : hmlfc_dut_geometry{};
}

CommandDecoder::CommandDecoder(const Dut& dut, const ProcessLimits& limits,
                               std::filesystem::path output)
    : dut_(dut), limits_(limits), output_(std::move(output)) {
  abilities_.at_once = true;
  abilities_.views = dut.command != dut.frame;
  abilities_.traces = !dut.trace.empty();
}

DutAnswer<hmlfc_dut_geometry> CommandDecoder::open(const std::filesystem::path& file) {
  file_ = file;
  views_.clear();
  const hmlfc_dut_geometry geometry = geometry_of(file);  // before the command has had it
  shape_ = {geometry.rows, geometry.cols, geometry.width, geometry.height,
            static_cast<int>(geometry.depth)};
  const Places places{{"input", file.string()}, {"output", output_.string()}};
  const ProcessOutcome outcome = run_command(fill_in(dut_.command, places), limits_);
  messages_ = outcome.messages;
  if (outcome.value == 0) return geometry;
  std::string name =
      dut_.error_names ? first_name(outcome.messages, all_error_names()) : std::string();
  if (!name.empty()) return tl::unexpected(std::move(name));
  return tl::unexpected(to_string(outcome) + last_words(outcome.messages));
}

DutAnswer<RgbImage> CommandDecoder::view(ViewPos view) {
  if (views_.empty()) {
    auto views = read_output_views(output_, shape_);
    if (!views) wrong_output(output_, views.error().message);
    views_ = std::move(*views);
  }
  return views_[size_t{view.row} * shape_.cols + view.col];
}

DutAnswer<std::string> CommandDecoder::trace(const BlockAddress& block, int) {
  const Places places{{"input", file_.string()},
                      {"view_row", std::to_string(block.view.row)},
                      {"view_col", std::to_string(block.view.col)},
                      {"plane", std::to_string(static_cast<unsigned>(block.plane))},
                      {"block_x", std::to_string(block.bx)},
                      {"block_y", std::to_string(block.by)}};
  ProcessOutcome outcome = run_process(fill_in(dut_.trace, places), limits_);
  if (outcome.output.empty()) return tl::unexpected(to_string(outcome));
  return std::move(outcome.output);
}

std::string CommandDecoder::take_messages() { return std::exchange(messages_, {}); }

}  // namespace hmlfc::conform
