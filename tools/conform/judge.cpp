#include "conform/judge.hpp"

#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conform/difference.hpp"
#include "conform/output_views.hpp"
#include "conform/stage_trace.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::conform {
namespace {

// Exit statuses of a shell or env for a program that does not exist.
constexpr int kNotExecutable = 126;
constexpr int kNotFound = 127;

void set(VectorResult& result, Status status, std::string reason) {
  result.status = status;
  result.reason = std::move(reason);
}

// ": " and the last line of the decoder's messages, if there is one.
std::string last_words(std::string_view text) {
  const size_t end = text.find_last_not_of(" \r\n");
  if (end == std::string_view::npos) return {};
  const size_t line_break = text.find_last_of('\n', end);
  const size_t begin = line_break == std::string_view::npos ? 0 : line_break + 1;
  return ": " + std::string(text.substr(begin, end + 1 - begin));
}

// Whether `text` contains `word` without a letter, digit or underscore next to it.
bool has_word(const std::string& text, std::string_view word) {
  return std::regex_search(text, std::regex("\\b" + std::string(word) + "\\b"));
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

// Whether `messages` name the error of one of the views that fail (DEC-7): a decoder may report
// any of them first.
bool names_a_view_error(const std::string& messages, std::span<const uint8_t> stream) {
  const auto golden = Decoder::open(stream);
  if (!golden) return false;
  const StreamHeader& header = golden->header();
  for (uint32_t view = 0; view < header.rows * header.cols; ++view) {
    const auto image = golden->decode_view({view / header.cols, view % header.cols});
    if (!image && has_word(messages, error_name(image.error().code))) return true;
  }
  return false;
}

void judge_refusal(const Trial& trial, const ProcessOutcome& outcome,
                   const vectors::Expectation& expect, VectorResult& result) {
  const std::string name(error_name(expect.error));
  if (outcome.value == 0) {
    return set(result, Status::kFail, "accepted, but must be refused with " + name);
  }
  const bool named = !trial.dut.error_names || has_word(outcome.messages, name) ||
                     (expect.operation == vectors::Operation::kBlock &&
                      names_a_view_error(outcome.messages, trial.stream));
  if (!named) {
    return set(
        result, Status::kFail,
        fmt::format("refused with another error than {}{}", name, last_words(outcome.messages)));
  }
  set(result, Status::kPass, {});
}

// What another run of the decoder, which traces the block, shows of its stages in one plane.
std::string wrong_stage(const Trial& trial, const Decoder& golden, const BlockAddress& block) {
  const Places places{{"input", trial.input.string()},
                      {"view_row", std::to_string(block.view.row)},
                      {"view_col", std::to_string(block.view.col)},
                      {"plane", std::to_string(static_cast<unsigned>(block.plane))},
                      {"block_x", std::to_string(block.bx)},
                      {"block_y", std::to_string(block.by)}};
  const ProcessOutcome outcome = run_process(fill_in(trial.dut.trace, places), trial.limits);
  const auto stages = parse_stages(outcome.output);
  if (stages.empty()) return "no trace: " + to_string(outcome);
  if (auto stage = first_wrong_stage(golden, block, stages)) return *stage;
  return fmt::format("all stages of plane {} agree in the decoder's trace",
                     plane_name(block.plane));
}

// The first wrong stage in each plane that differs.
std::string wrong_stages(const Trial& trial, const Decoder& golden, const Difference& difference) {
  if (trial.dut.trace.empty()) return {};
  std::vector<std::string> said;
  for (const Plane plane : difference.planes) {
    const bool halved = plane != Plane::kY && golden.header().chroma_format == ChromaFormat::k420;
    said.push_back(wrong_stage(trial, golden,
                               {difference.view, plane, difference.block_x >> (halved ? 1 : 0),
                                difference.block_y >> (halved ? 1 : 0)}));
  }
  return fmt::format("{}", fmt::join(said, "; "));
}

std::vector<RgbImage> golden_views(const Decoder& golden) {
  const StreamHeader& header = golden.header();
  std::vector<RgbImage> views;
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      auto view = golden.decode_view({row, col});
      if (!view) return {};
      views.push_back(std::move(*view));
    }
  }
  return views;
}

std::string sum_of(const std::vector<RgbImage>& views) {
  std::vector<uint8_t> raw;
  for (const RgbImage& view : views) {
    const auto bytes = vectors::picture_bytes(view);
    raw.insert(raw.end(), bytes.begin(), bytes.end());
  }
  return vectors::sha256(raw);
}

// Where the views differ from the golden model's.
void describe_difference(const Trial& trial, const Decoder& golden,
                         const std::vector<RgbImage>& expected, const std::vector<RgbImage>& actual,
                         VectorResult& result) {
  const StreamHeader& header = golden.header();
  std::vector<BlockMap> maps;
  result.difference = first_difference(expected, actual, header.cols, header.block_size(), maps);
  if (!result.difference) return;
  const Difference& difference = *result.difference;
  result.reason = to_string(difference);
  result.stage = wrong_stages(trial, golden, difference);
  if (trial.pictures.empty()) return;
  const size_t view = size_t{difference.view.row} * header.cols + difference.view.col;
  const RgbImage heat = heat_map(maps, header.cols, view);
  const auto written = write_failure_pictures(trial.pictures, expected[view], actual[view], heat);
  if (!written) result.messages += "\n" + written.error().message;
}

void judge_views(const Trial& trial, const vectors::ViewSum* output, VectorResult& result) {
  OpenOptions options;
  options.check_sections = false;  // the decoder may have left CRCs unchecked (FIL-6)
  const auto golden = Decoder::open(trial.stream, options);
  if (!golden) {
    return set(result, Status::kError,
               "the golden model cannot open the stream: " + to_string(golden.error()));
  }
  const StreamHeader& header = golden->header();
  const LightFieldShape shape{header.rows, header.cols, header.width, header.height, header.depth};
  const auto actual = read_output_views(trial.output, shape);
  if (!actual) return set(result, Status::kFail, "wrong output: " + actual.error().message);
  if (output != nullptr && sum_of(*actual) == output->sha256) {
    return set(result, Status::kPass, {});
  }
  const auto expected = golden_views(*golden);
  if (expected.empty()) {
    return set(result, Status::kError, "the golden model cannot decode the stream");
  }
  set(result, Status::kFail, {});
  describe_difference(trial, *golden, expected, *actual, result);
  if (result.difference) return;
  if (output == nullptr) return set(result, Status::kPass, {});
  set(result, Status::kError,
      "equal to the golden model, which differs from the manifest: the suite is of another version "
      "or damaged");
}

}  // namespace

void judge(const Trial& trial, const ProcessOutcome& outcome, const vectors::Expectation& expect,
           const vectors::ViewSum* output, VectorResult& result) {
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
    judge_views(trial, output, result);
  }
  if (result.status == Status::kPass) result.messages.clear();
}

}  // namespace hmlfc::conform
