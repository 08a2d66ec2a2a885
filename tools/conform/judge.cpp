#include "conform/judge.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "conform/block_judge.hpp"
#include "conform/running_dut.hpp"
#include "conform/view_assembly.hpp"
#include "conform/view_judge.hpp"

namespace hmlfc::conform {
namespace {

using vectors::Operation;
using vectors::Outcome;

constexpr uint64_t kBlocksOfFailingStream = 256;  // at each stop level above 0
constexpr uint64_t kBlocksOfValidStream = 16;     // at each stop level

// Writes the stream to `trial.input`, where a run before may have left anything.
void hand_over(const Trial& trial) {
  std::error_code ignored;
  std::filesystem::remove_all(trial.input, ignored);
  std::ofstream file(trial.input, std::ios::binary);
  file.write(reinterpret_cast<const char*>(trial.stream.data()),
             static_cast<std::streamsize>(trial.stream.size()));
  file.close();
  if (file) return;
  throw DutFailure{Status::kError, trial.input.string() + ": the stream cannot be copied there"};
}

// Calls body(view) for each view, row by row.
template <class Body>
void for_each_view(const Decoder& golden, const Body& body) {
  const StreamHeader& header = golden.header();
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) body(ViewPos{row, col});
  }
}

// One stream in one process.
class Judge {
 public:
  Judge(const Trial& trial, const vectors::Expectation& expect, const vectors::ViewSum* output,
        RunningDut& dut, VectorResult& result)
      : trial_(trial), expect_(expect), output_(output), dut_(dut), result_(result) {}

  // Throws DutFailure.
  void run() {
    const auto geometry = dut_.open(trial_.input);
    if (!geometry) return judge_refusal(geometry.error());
    // FIL-6: a decoder that reads whole sections may not leave their crc unchecked.
    if (fails_at_open() && (expect_.outcome == Outcome::kReject || trial_.dut.checks_sections)) {
      fail(fmt::format("accepted, but must be refused with {}", error_name(expect_.error)));
    } else if (const auto golden = golden_decoder(trial_, result_)) {
      compare(*golden, *geometry);
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
    bool found = false;
    if (!golden) return found;
    for_each_view(*golden, [&](ViewPos view) {
      const auto image = golden->decode_view(view);
      found |= !image && error == error_name(image.error().code);
    });
    return found;
  }

  Tracer tracer() {
    if (!dut_.can().traces) return {};
    return [this](const BlockAddress& block, int level) {
      // A command may have changed its copy of the stream.
      if (dut_.can().at_once) hand_over(trial_);
      return dut_.trace(block, level);
    };
  }

  void compare(const Decoder& golden, const hmlfc_dut_geometry& geometry) {
    if (const auto what = wrong_geometry(golden.header(), geometry)) {
      return fail("wrong answer to 'open': " + *what);
    }
    if (expect_.outcome == Outcome::kReject) return compare_failing(golden);
    std::vector<RgbImage> views;
    bool refused = false;
    for_each_view(golden, [&](ViewPos view) {
      auto answer = view_of(dut_, trial_.dut.by_block, golden, view);
      if (answer) views.push_back(std::move(*answer));
      if (answer || std::exchange(refused, true)) return;
      fail(fmt::format("refused a valid stream at view {},{}: {}", view.row, view.col,
                       answer.error()));
    });
    if (refused) return;
    judge_views(trial_, golden, views, output_, tracer(), result_);
    if (passes() && dut_.can().blocks) {
      judge_blocks(golden, dut_, tracer(), {kBlocksOfValidStream, kBlocksOfValidStream}, result_);
    }
  }

  // A stream that opens and in which blocks fail: each of them, then the views.
  void compare_failing(const Decoder& golden) {
    if (!suite_agrees(golden, expect_, trial_.blocks)) {
      return set(Status::kError,
                 "the golden model differs from the manifest: the suite is of another version or "
                 "damaged");
    }
    set(Status::kPass, {});
    if (dut_.can().blocks) {
      judge_blocks(golden, dut_, tracer(), {kAllBlocks, kBlocksOfFailingStream}, result_);
    }
    if (passes()) judge_failing_views(golden);
  }

  // A view fails with the error of DEC-7, or decodes.
  void judge_failing_views(const Decoder& golden) {
    const StreamHeader& header = golden.header();
    const RgbImage blank{header.width, header.height, header.depth,
                         std::vector<uint16_t>(size_t{header.width} * header.height * 3)};
    std::vector<RgbImage> expected;
    std::vector<RgbImage> actual;
    for_each_view(golden, [&](ViewPos view) {
      auto right = golden.decode_view(view);
      auto answer = view_of(dut_, trial_.dut.by_block, golden, view);
      if (outcome_name(right) != outcome_name(answer) && passes()) {
        result_.kind = fmt::format("{} instead of {}", outcome_name(answer), outcome_name(right));
        fail(fmt::format("view {},{}: {}", view.row, view.col, result_.kind));
        result_.kind += " of a view";
      }
      const bool both = right && answer;
      expected.push_back(both ? std::move(*right) : blank);
      actual.push_back(both ? std::move(*answer) : blank);
    });
    if (passes()) describe_difference(trial_, golden, expected, actual, tracer(), result_);
  }

  const Trial& trial_;
  const vectors::Expectation& expect_;
  const vectors::ViewSum* output_;
  RunningDut& dut_;
  VectorResult& result_;
};

}  // namespace

void judge(const Trial& trial, const vectors::Expectation& expect, const vectors::ViewSum* output,
           VectorResult& result) {
  using Clock = std::chrono::steady_clock;
  const VectorResult before = result;
  WaitingDuts* const waiting = trial.dut.waiting.get();
  auto dut = waiting != nullptr ? waiting->take() : nullptr;
  const auto judge_in = [&](std::unique_ptr<RunningDut>& process, VectorResult& judged) {
    const auto begin = Clock::now();
    try {
      hand_over(trial);
      if (process == nullptr) {
        process = start(trial.dut, trial.limits, trial.output);
      } else {
        process->allow(trial.limits.seconds);
      }
      Judge(trial, expect, output, *process, judged).run();
    } catch (const DutFailure& failure) {
      judged.status = failure.status;
      judged.reason = failure.reason;
      judged.messages = failure.messages + (process ? process->take_messages() : std::string());
      process.reset();
    }
    if (process != nullptr) judged.messages = process->take_messages() + judged.messages;
    judged.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const bool used = dut != nullptr;
  judge_in(dut, result);
  if (used && result.bad() && result.status != Status::kTimeout && waiting->is_run_again()) {
    VectorResult again = before;
    dut.reset();
    judge_in(dut, again);
    if (!again.bad()) result.reason += " (but passes as the first stream of a process)";
  }
  if (waiting != nullptr && dut != nullptr) waiting->give_back(std::move(dut));
  if (result.status == Status::kPass) result.messages.clear();
}

}  // namespace hmlfc::conform
