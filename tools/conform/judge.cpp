#include "conform/judge.hpp"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "conform/line_judge.hpp"
#include "conform/output_views.hpp"
#include "conform/view_judge.hpp"

namespace hmlfc::conform {
namespace {

// Exit statuses of a shell or env for a program that does not exist.
constexpr int kNotExecutable = 126;
constexpr int kNotFound = 127;

void set(VectorResult& result, Status status, std::string reason) {
  result.status = status;
  result.reason = std::move(reason);
}

// The first word of `messages` that is the name of an error; ErrorCode::kOk if there is none. A
// word has no letter, digit or underscore next to it.
ErrorCode first_error(std::string_view messages) {
  size_t end = 0;
  for (size_t at = 0; (at = messages.find_first_of(kWordCharacters, end)) != messages.npos;) {
    end = std::min(messages.find_first_not_of(kWordCharacters, at), messages.size());
    for (int code = 1; code < kErrorCodeCount; ++code) {
      const auto error = static_cast<ErrorCode>(code);
      if (messages.substr(at, end - at) == error_name(error)) return error;
    }
  }
  return ErrorCode::kOk;
}

// Handles outcomes that fail any vector: a crash, a missing program, a timeout. True if it is one.
bool judge_process(const ProcessOutcome& outcome, VectorResult& result) {
  if (outcome.end == ProcessEnd::kTimeout) {
    set(result, Status::kTimeout, to_string(outcome));
  } else if (outcome.end != ProcessEnd::kExit || outcome.value == kNotExecutable ||
             outcome.value == kNotFound) {
    set(result, Status::kError, to_string(outcome) + last_words(outcome.messages));
  } else if (outcome.value == kExitSkipped) {
    set(result, Status::kSkipped, "the decoder cannot run here" + last_words(outcome.messages));
  } else {
    return false;
  }
  return true;
}

// Whether one of the views that fail does so with `error`: a decoder of all views may report any of
// them (DEC-7).
bool is_error_of_a_view(ErrorCode error, std::span<const uint8_t> stream) {
  const auto golden = Decoder::open(stream);
  if (!golden) return false;
  const StreamHeader& header = golden->header();
  for (uint32_t view = 0; view < header.rows * header.cols; ++view) {
    const auto image = golden->decode_view({view / header.cols, view % header.cols});
    if (!image && image.error().code == error) return true;
  }
  return false;
}

void judge_refusal(const Trial& trial, const ProcessOutcome& outcome,
                   const vectors::Expectation& expect, VectorResult& result) {
  const std::string name(error_name(expect.error));
  if (outcome.value == 0) {
    return set(result, Status::kFail, "accepted, but must be refused with " + name);
  }
  const ErrorCode error = first_error(outcome.messages);
  const bool named =
      !trial.dut.error_names || error == expect.error ||
      (expect.operation == vectors::Operation::kBlock && is_error_of_a_view(error, trial.stream));
  if (!named) {
    return set(
        result, Status::kFail,
        fmt::format("refused with another error than {}{}", name, last_words(outcome.messages)));
  }
  set(result, Status::kPass, {});
}

// The stages of a block from another run of the decoder.
Tracer tracer_of(const Trial& trial) {
  if (trial.dut.trace.empty()) return {};
  return [&trial](const BlockAddress& block, int) -> tl::expected<std::string, std::string> {
    if (const auto handed = hand_over(trial); !handed) {
      return tl::unexpected(handed.error().message);
    }
    return trace_by_command(trial.dut, trial.input, block, trial.limits);
  };
}

void judge_output(const Trial& trial, const vectors::ViewSum* output, VectorResult& result) {
  const auto golden = golden_decoder(trial, result);
  if (!golden) return;
  const StreamHeader& header = golden->header();
  const LightFieldShape shape{header.rows, header.cols, header.width, header.height, header.depth};
  const auto actual = read_output_views(trial.output, shape);
  if (!actual) {
    std::string reason = "wrong output: " + actual.error().message;
    const std::string above = trial.output.parent_path().string() + "/";
    const size_t at = reason.find(above);
    if (at != reason.npos) reason.erase(at, above.size());
    return set(result, Status::kFail, std::move(reason));
  }
  judge_views(trial, *golden, *actual, output, tracer_of(trial), result);
}

void judge_command(const Trial& trial, const vectors::Expectation& expect,
                   const vectors::ViewSum* output, VectorResult& result) {
  if (const auto handed = hand_over(trial); !handed) {
    return set(result, Status::kError, handed.error().message);
  }
  const Places places{{"input", trial.input.string()}, {"output", trial.output.string()}};
  const ProcessOutcome outcome = run_process(fill_in(trial.dut.command, places), trial.limits);
  result.seconds = outcome.seconds;
  result.messages = outcome.messages;
  using vectors::Outcome;
  // FIL-6: a decoder that reads whole sections may not leave their crc unchecked.
  const bool must_refuse = trial.dut.checks_sections || outcome.value != 0;
  if (judge_process(outcome, result)) {
  } else if (expect.outcome == Outcome::kReject ||
             (expect.outcome == Outcome::kAcceptable && must_refuse)) {
    judge_refusal(trial, outcome, expect, result);
  } else if (outcome.value != 0) {
    set(result, Status::kFail,
        fmt::format("refused a valid stream with {}{}", to_string(outcome),
                    last_words(outcome.messages)));
  } else {
    judge_output(trial, output, result);
  }
}

}  // namespace

io::IoResult<void> hand_over(const Trial& trial) {
  std::error_code ignored;
  std::filesystem::remove_all(trial.input, ignored);
  std::ofstream file(trial.input, std::ios::binary);
  file.write(reinterpret_cast<const char*>(trial.stream.data()),
             static_cast<std::streamsize>(trial.stream.size()));
  file.close();
  if (!file) return io::file_error(trial.input, "the stream cannot be copied there");
  return {};
}

tl::expected<std::string, std::string> trace_by_command(const Dut& dut,
                                                        const std::filesystem::path& input,
                                                        const BlockAddress& block,
                                                        const ProcessLimits& limits) {
  const Places places{{"input", input.string()},
                      {"view_row", std::to_string(block.view.row)},
                      {"view_col", std::to_string(block.view.col)},
                      {"plane", std::to_string(static_cast<unsigned>(block.plane))},
                      {"block_x", std::to_string(block.bx)},
                      {"block_y", std::to_string(block.by)}};
  ProcessOutcome outcome = run_process(fill_in(dut.trace, places), limits);
  if (outcome.output.empty()) return tl::unexpected(to_string(outcome));
  return std::move(outcome.output);
}

void judge(const Trial& trial, const vectors::Expectation& expect, const vectors::ViewSum* output,
           VectorResult& result) {
  if (trial.dut.lines != nullptr) {
    judge_lines(trial, expect, output, result);
  } else {
    judge_command(trial, expect, output, result);
  }
  if (result.status == Status::kPass) result.messages.clear();
}

}  // namespace hmlfc::conform
