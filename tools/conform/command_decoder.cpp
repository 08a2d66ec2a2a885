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

// The first word of `messages` that is the name of an error; empty if there is none. A word has no
// letter, digit or underscore next to it.
std::string first_error_name(std::string_view messages) {
  size_t end = 0;
  for (size_t at = 0; (at = messages.find_first_of(kWordCharacters, end)) != messages.npos;) {
    end = std::min(messages.find_first_not_of(kWordCharacters, at), messages.size());
    const std::string_view word = messages.substr(at, end - at);
    for (int code = 1; code < kErrorCodeCount; ++code) {
      if (word == error_name(static_cast<ErrorCode>(code))) return std::string(word);
    }
  }
  return {};
}

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

CommandDecoder::CommandDecoder(const Dut& dut, const ProcessLimits& limits,
                               std::filesystem::path output)
    : dut_(dut), limits_(limits), output_(std::move(output)) {
  abilities_.views = abilities_.at_once = true;
  abilities_.traces = !dut.trace.empty();
}

DutAnswer<hmlfc_dut_geometry> CommandDecoder::open(const std::filesystem::path& file) {
  file_ = file;
  views_.clear();
  hmlfc_dut_geometry geometry{};
  // Before the command has had the file.
  if (const auto mapped = io::map_file(file)) {
    if (const auto header = parse_header(mapped->bytes())) {
      geometry = dut_geometry(*header);
      shape_ = {header->rows, header->cols, header->width, header->height, header->depth};
    }
  }
  const Places places{{"input", file.string()}, {"output", output_.string()}};
  const ProcessOutcome outcome = run_process(fill_in(dut_.command, places), limits_);
  check_ended(outcome);
  messages_ = outcome.messages;
  if (outcome.value == 0) return geometry;
  std::string name = dut_.error_names ? first_error_name(outcome.messages) : std::string();
  if (!name.empty()) return tl::unexpected(std::move(name));
  return tl::unexpected(to_string(outcome) + last_words(outcome.messages));
}

DutAnswer<RgbImage> CommandDecoder::view(ViewPos view) {
  if (views_.empty()) {
    auto views = read_output_views(output_, shape_);
    if (!views) {
      std::string reason = "wrong output: " + views.error().message;
      const std::string above = output_.parent_path().string() + "/";
      const size_t at = reason.find(above);
      if (at != reason.npos) reason.erase(at, above.size());
      throw DutFailure{Status::kFail, std::move(reason)};
    }
    views_ = std::move(*views);
  }
  return views_[size_t{view.row} * shape_.cols + view.col];
}

DutAnswer<std::vector<int32_t>> CommandDecoder::block(const BlockAddress&, int) {
  throw DutFailure{Status::kError, "a command line is not asked for blocks"};
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
