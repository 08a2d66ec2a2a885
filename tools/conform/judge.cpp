#include "conform/judge.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conform/frame_judge.hpp"
#include "conform/running_dut.hpp"
#include "conform/stage_trace.hpp"
#include "conform/view_assembly.hpp"
#include "conform/work_folder.hpp"
#include "io/files.hpp"
#include "vectors/digest.hpp"
#include "vectors/expected.hpp"

namespace hmlfc::conform {
namespace {

using vectors::Operation;
using vectors::Outcome;

constexpr uint64_t kBlocksOfFailingStream = 256;  // at each stop level above 0
constexpr uint64_t kBlocksOfValidStream = 16;     // at each stop level

// Writes the stream to `trial.input`, where a run before may have left anything.
void hand_over(const Trial& trial) {
  remove_tree(trial.input);
  if (io::write_file(trial.input, trial.stream)) return;
  throw DutFailure{Status::kError, trial.input.string() + ": the stream cannot be copied there"};
}

// "bad_mode", or "samples" where there is no error.
template <class T>
std::string outcome_name(const DutAnswer<T>& answer) {
  return answer ? "samples" : answer.error();
}

template <class T>
std::string outcome_name(const Result<T>& golden) {
  return golden ? "samples" : std::string(error_name(golden.error().code));
}

// Views row by row.
std::vector<ViewPos> views_of(const StreamHeader& header) {
  std::vector<ViewPos> views;
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) views.push_back({row, col});
  }
  return views;
}

// Whether all answers are views whose samples have the SHA-256 of the manifest.
bool have_sum(const std::vector<DutAnswer<RgbImage>>& answers, const vectors::ViewSum& views) {
  std::vector<uint8_t> raw;
  for (const auto& answer : answers) {
    if (!answer) return false;
    const auto bytes = vectors::picture_bytes(*answer);
    raw.insert(raw.end(), bytes.begin(), bytes.end());
  }
  return vectors::sha256(raw) == views.sha256;
}

// Whether the golden model has the errors that the manifest states by hand, and the checksums of
// all other blocks in the trial's blocks file.
bool suite_agrees(const Trial& trial, const Decoder& golden) {
  const auto is_stated = [&](const BlockAddress& block) {
    const auto decoded = golden.decode_block(block);
    return !decoded && decoded.error().code == trial.expect.error;
  };
  if (!std::ranges::all_of(trial.expect.blocks, is_stated)) return false;
  if (trial.blocks.empty()) return true;
  const auto file = io::map_file(trial.blocks);
  return file && std::ranges::equal(file->bytes(), vectors::expected_views(golden).blocks, {}, {},
                                    [](char c) { return static_cast<uint8_t>(c); });
}

// One stream in one process.
class StreamJudge {
 public:
  StreamJudge(const Trial& trial, RunningDut& dut, VectorResult& result)
      : trial_(trial), expect_(trial.expect), dut_(dut), result_(result) {}

  // Throws DutFailure.
  void run() {
    if (!dut_.can().views && !dut_.can().blocks) {
      return set(Status::kNotSupported, "the renderer decodes neither views nor blocks");
    }
    const auto geometry = dut_.open(trial_.input);
    if (!geometry) return judge_refusal(geometry.error());
    // FIL-6: a decoder that reads whole sections may not leave their crc unchecked, others may.
    if (fails_at_open() && (expect_.outcome == Outcome::kReject || trial_.dut.checks_sections)) {
      fail(fmt::format("accepted, but must be refused with {}", error_name(expect_.error)));
    } else if (const auto golden = Decoder::open(trial_.stream, {.check_sections = false})) {
      compare(*golden, *geometry);
    } else {
      set(Status::kError, "the golden model cannot open the stream: " + to_string(golden.error()));
    }
    dut_.close();
  }

 private:
  void set(Status status, std::string reason) {
    result_.status = status;
    result_.reason = std::move(reason);
  }
  void fail(std::string reason) { set(Status::kFail, std::move(reason)); }
  bool passes() const { return result_.status == Status::kPass; }

  // Whether the decoder may or must refuse the stream as it opens it.
  bool fails_at_open() const {
    return expect_.outcome != Outcome::kOk &&
           (expect_.operation == Operation::kOpen || dut_.can().at_once);
  }

  void judge_refusal(const std::string& error) {
    if (expect_.outcome == Outcome::kOk) {
      const char* at_open = dut_.can().at_once ? " with " : " at 'open': ";
      return fail(fmt::format("refused a valid stream{}{}", at_open, error));
    }
    if (!fails_at_open()) {
      fail("refused at 'open', but only blocks fail: " + error);
      result_.kind = "refused at 'open' where only blocks fail";
      return;
    }
    if (!trial_.dut.error_names || error == error_name(expect_.error) ||
        (expect_.operation == Operation::kBlock && is_error_of_a_view(error))) {
      return set(Status::kPass, {});
    }
    fail(fmt::format("refused with another error than {}: {}", error_name(expect_.error), error));
  }

  // Whether one of the views that fail does so with `error`: a decoder of all views may report any
  // of them (DEC-7).
  bool is_error_of_a_view(const std::string& error) const {
    const auto golden = Decoder::open(trial_.stream);
    return golden && std::ranges::any_of(views_of(golden->header()), [&](ViewPos view) {
             const auto image = golden->decode_view(view);
             return !image && error == error_name(image.error().code);
           });
  }

  void compare(const Decoder& golden, const hmlfc_dut_geometry& geometry) {
    if (const auto what = wrong_geometry(golden.header(), geometry)) {
      return fail("wrong answer to 'open': " + *what);
    }
    const bool failing = expect_.outcome == Outcome::kReject;
    if (failing && !suite_agrees(trial_, golden)) {
      return set(Status::kError,
                 "the golden model differs from the manifest: the suite is of another version or "
                 "damaged");
    }
    set(Status::kPass, {});
    if (!failing) judge_views(golden);
    if (passes() && dut_.can().blocks) judge_blocks(golden, failing);
    if (passes() && failing) judge_views(golden);
  }

  // Each view decodes to the right samples, or fails with the error of DEC-7.
  void judge_views(const Decoder& golden) {
    const auto places = views_of(golden.header());
    std::vector<DutAnswer<RgbImage>> answers;
    for (const ViewPos view : places) {
      answers.push_back(view_of(dut_, trial_.dut.by_block, golden, view));
    }
    if (trial_.views != nullptr && have_sum(answers, *trial_.views)) return;
    const StreamHeader& header = golden.header();
    const RgbImage blank{header.width, header.height, header.depth,
                         std::vector<uint16_t>(size_t{header.width} * header.height * 3)};
    std::vector<RgbImage> expected(places.size(), blank);
    std::vector<RgbImage> actual(places.size(), blank);
    for (size_t i = 0; i < places.size() && passes(); ++i) {
      auto right = golden.decode_view(places[i]);
      if (!right && expect_.outcome != Outcome::kReject) {
        return set(Status::kError, "the golden model cannot decode the stream");
      }
      if (outcome_name(right) != outcome_name(answers[i])) {
        const std::string what = outcome_name(answers[i]) + " instead of " + outcome_name(right);
        fail(fmt::format("view {},{}: {}", places[i].row, places[i].col, what));
        result_.kind = what + " of a view";
      } else if (right) {
        expected[i] = std::move(*right);
        actual[i] = std::move(*answers[i]);
      }
    }
    if (passes()) describe_difference(golden, expected, actual);
    if (!passes() || trial_.views == nullptr) return;
    set(Status::kError, kOtherSuite);
  }

  // Sets difference, reason, stage and pictures where the views differ.
  void describe_difference(const Decoder& golden, const std::vector<RgbImage>& expected,
                           const std::vector<RgbImage>& actual) {
    const StreamHeader& header = golden.header();
    result_.difference = first_difference(expected, actual, header.cols, header.block_size());
    if (!result_.difference) return;
    const Difference& difference = *result_.difference;
    fail(to_string(difference));
    std::vector<std::string> stages;
    for (const Plane plane : difference.planes) {
      if (dut_.can().traces) {
        stages.push_back(wrong_stage(golden, difference.block(plane, header.chroma_format), 0));
      }
    }
    result_.stage = fmt::format("{}", fmt::join(stages, "; "));
    if (trial_.pictures.empty()) return;
    const size_t view = size_t{difference.view.row} * header.cols + difference.view.col;
    const auto written = write_failure_pictures(trial_.pictures, expected[view], actual[view]);
    if (!written) result_.messages += "\n" + written.error().message;
  }

  // The first wrong stage of a block, or why none is known. Empty where there are no traces.
  std::string wrong_stage(const Decoder& golden, const BlockAddress& block, int level) {
    if (!dut_.can().traces) return {};
    if (dut_.can().at_once) hand_over(trial_);  // a command may have changed its copy
    const auto trace = dut_.trace(block, level);
    const auto stages = parse_stages(trace ? std::string_view(*trace) : std::string_view());
    if (stages.empty()) return "no trace" + (trace ? "" : ": " + trace.error());
    if (auto stage = first_wrong_stage(golden, block, level, stages)) return *stage;
    return fmt::format("all stages of plane {} agree in the decoder's trace",
                       plane_name(block.plane));
  }

  // Blocks that are spread evenly over the stream; a failure is described by the first wrong one.
  void judge_blocks(const Decoder& golden, bool failing) {
    std::vector<BlockAddress> blocks;
    vectors::for_each_block(golden, [&](const BlockAddress& block) { blocks.push_back(block); });
    const int top = dut_.can().levels ? golden.header().tree_height : 0;
    uint64_t asked = 0;
    uint64_t wrong = 0;
    for (int level = 0; level <= top; ++level) {
      const uint64_t most = !failing     ? kBlocksOfValidStream
                            : level == 0 ? blocks.size()
                                         : kBlocksOfFailingStream;
      const uint64_t n = std::min<uint64_t>(blocks.size(), most);
      for (uint64_t i = 0; i < n; ++i, ++asked) {
        const uint64_t number = i * blocks.size() / n + static_cast<uint64_t>(level);
        wrong += !agrees(golden, blocks[number % blocks.size()], level);
      }
    }
    if (wrong != 0) result_.reason += fmt::format("; {} of {} blocks asked for", wrong, asked);
  }

  // Whether a block is right inside the plane; the first that is not sets the result.
  bool agrees(const Decoder& golden, const BlockAddress& block, int level) {
    const auto expected = golden.decode_block(block, {.stop_level = level});
    const auto actual = dut_.block(block, level);
    std::optional<std::string> what;
    if (outcome_name(expected) != outcome_name(actual)) {
      what = outcome_name(actual) + " instead of " + outcome_name(expected);
    } else if (expected) {
      what = first_wrong_value(golden, block.plane, block.bx, block.by, *expected, *actual);
    }
    if (!what || !passes()) return !what;
    const std::string_view plane = plane_name(block.plane);
    fail(fmt::format("view {},{} plane {} block {},{} at stop level {}: {}", block.view.row,
                     block.view.col, plane, block.bx, block.by, level, *what));
    const bool samples = expected && actual;
    result_.kind = fmt::format("{} of plane {} at {}", samples ? "wrong samples" : *what, plane,
                               level == 0 ? "stop level 0" : "stop levels above 0");
    if (samples) result_.stage = wrong_stage(golden, block, level);
    return false;
  }

  const Trial& trial_;
  const vectors::Expectation& expect_;
  RunningDut& dut_;
  VectorResult& result_;
};

// Runs a trial in `dut`, or in a new process where it is null. Leaves null where that has failed.
void judge_in(std::unique_ptr<RunningDut>& dut, const Trial& trial, VectorResult& result) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  try {
    hand_over(trial);
    if (dut == nullptr) {
      dut = start(trial.dut, trial.limits, trial.output, trial.frame != nullptr);
    } else {
      dut->allow(trial.limits.seconds);
    }
    if (trial.frame != nullptr) judge_frame(trial, *dut, result);
    if (trial.frame == nullptr) StreamJudge(trial, *dut, result).run();
  } catch (const DutFailure& failure) {
    result.status = failure.status;
    result.reason = failure.reason;
    result.messages = failure.messages + (dut ? dut->take_messages() : std::string());
    dut.reset();
  }
  if (dut != nullptr) result.messages = dut->take_messages() + result.messages;
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

void judge(const Trial& trial, VectorResult& result) {
  const VectorResult before = result;
  WaitingDuts* const waiting = trial.dut.waiting.get();
  auto dut = waiting != nullptr ? waiting->take() : nullptr;
  const bool used = dut != nullptr;
  judge_in(dut, trial, result);
  if (used && result.bad() && result.status != Status::kTimeout && waiting->is_run_again()) {
    VectorResult again = before;
    dut.reset();
    judge_in(dut, trial, again);
    if (!again.bad()) result.reason += " (but passes as the first stream of a process)";
  }
  if (waiting != nullptr && dut != nullptr) waiting->give_back(std::move(dut));
  if (result.status == Status::kPass) result.messages.clear();
}

}  // namespace hmlfc::conform
