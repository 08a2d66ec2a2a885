#include "conform/line_judge.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "conform/line_decoder.hpp"
#include "conform/view_assembly.hpp"
#include "conform/view_judge.hpp"
#include "io/files.hpp"
#include "vectors/expected.hpp"

namespace hmlfc::conform {
namespace {

constexpr uint64_t kBlocksOfFailingStream = 256;  // at each stop level above 0
constexpr uint64_t kBlocksOfValidStream = 16;     // at each stop level

// "bad_mode", or `samples` where there is no error.
template <class T>
std::string outcome_name(const LineAnswer<T>& answer) {
  return answer ? "samples" : answer.error();
}

template <class T>
std::string outcome_name(const Result<T>& golden) {
  return golden ? "samples" : std::string(error_name(golden.error().code));
}

// How a block's answer differs from the golden model's inside the plane; nothing if it does not.
std::optional<std::string> difference_of(const Decoder& golden, const BlockAddress& block,
                                         const Result<std::vector<int32_t>>& expected,
                                         const LineAnswer<std::vector<int32_t>>& actual) {
  if (outcome_name(expected) != outcome_name(actual)) {
    return fmt::format("{} instead of {}", outcome_name(actual), outcome_name(expected));
  }
  if (!expected) return std::nullopt;
  const uint32_t b = golden.header().block_size();
  const PlaneSize size = golden.plane_size(block.plane);
  for (uint32_t i = 0; i < b * b; ++i) {
    if (block.bx * b + i % b >= size.width || block.by * b + i / b >= size.height) continue;
    if ((*expected)[i] == (*actual)[i]) continue;
    return fmt::format("value {} (x {}, y {}) is {} instead of {}", i, i % b, i / b, (*actual)[i],
                       (*expected)[i]);
  }
  return std::nullopt;
}

// All blocks of a stream by number: view by view, plane by plane, row by row.
class BlockNumbers {
 public:
  explicit BlockNumbers(const Decoder& golden) : cols_(golden.header().cols) {
    const uint32_t b = golden.header().block_size();
    for (const Plane plane : kPlanes) {
      const PlaneSize size = golden.plane_size(plane);
      shapes_.push_back({(size.width + b - 1) / b, (size.height + b - 1) / b});
      of_view_ += uint64_t{shapes_.back().cols} * shapes_.back().rows;
    }
    count_ = of_view_ * cols_ * golden.header().rows;
  }

  uint64_t count() const { return count_; }

  // `number` is taken modulo count().
  BlockAddress at(uint64_t number) const {
    const auto view = static_cast<uint32_t>(number % count_ / of_view_);
    uint64_t in_view = number % of_view_;
    size_t plane = 0;
    for (; in_view >= uint64_t{shapes_[plane].cols} * shapes_[plane].rows; ++plane) {
      in_view -= uint64_t{shapes_[plane].cols} * shapes_[plane].rows;
    }
    const uint32_t cols = shapes_[plane].cols;
    return {{view / cols_, view % cols_},
            kPlanes[plane],
            static_cast<uint32_t>(in_view % cols),
            static_cast<uint32_t>(in_view / cols)};
  }

 private:
  struct Shape {
    uint32_t cols;
    uint32_t rows;
  };
  uint32_t cols_;
  std::vector<Shape> shapes_;
  uint64_t of_view_ = 0;
  uint64_t count_ = 0;
};

// One stream in one process.
class LineJudge {
 public:
  LineJudge(const Trial& trial, const vectors::Expectation& expect, const vectors::ViewSum* output,
            LineDecoder& dut, VectorResult& result)
      : trial_(trial), expect_(expect), output_(output), dut_(dut), result_(result) {}

  // Throws LineFailure.
  void run() {
    using vectors::Outcome;
    const bool at_open =
        expect_.outcome != Outcome::kOk && expect_.operation == vectors::Operation::kOpen;
    const std::string error(error_name(expect_.error));
    const auto geometry = dut_.open(trial_.input);
    if (!geometry) {
      if (!at_open) return fail_at_open(geometry.error());
      if (geometry.error() == error) return set(Status::kPass, {});
      return fail(fmt::format("refused with another error than {}: {}", error, geometry.error()));
    }
    // FIL-6: a decoder that reads whole sections may not leave their crc unchecked.
    if (at_open && (expect_.outcome == Outcome::kReject || trial_.dut.checks_sections)) {
      fail("accepted, but must be refused with " + error);
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

  // Refuses a stream that opens.
  void fail_at_open(const std::string& error) {
    if (expect_.outcome == vectors::Outcome::kOk) {
      return fail("refused a valid stream at 'open': " + error);
    }
    fail("refused at 'open', but only blocks fail: " + error);
    result_.kind = "refused at 'open' where only blocks fail";
  }

  void compare(const Decoder& golden, const hmlfc_dut_geometry& geometry) {
    if (const auto what = wrong_geometry(golden.header(), geometry)) {
      return fail("wrong answer to 'open': " + *what);
    }
    const BlockNumbers blocks(golden);
    if (expect_.outcome == vectors::Outcome::kReject) {
      if (!suite_agrees(golden)) {
        return set(Status::kError,
                   "the golden model differs from the manifest: the suite is of another version or "
                   "damaged");
      }
      set(Status::kPass, {});
      if (dut_.blocks()) judge_blocks(golden, blocks, blocks.count(), kBlocksOfFailingStream);
      if (passes()) judge_failing_views(golden);
      return;
    }
    std::vector<RgbImage> views;
    for_each_view(golden, [&](ViewPos view) {
      auto answer = view_of(golden, view);
      if (answer) views.push_back(std::move(*answer));
      if (!answer && result_.reason.empty()) {
        fail(fmt::format("refused a valid stream at view {},{}: {}", view.row, view.col,
                         answer.error()));
      }
    });
    if (!result_.reason.empty()) return;
    judge_views(trial_, golden, views, output_, tracer(), result_);
    if (passes() && dut_.blocks()) {
      judge_blocks(golden, blocks, kBlocksOfValidStream, kBlocksOfValidStream);
    }
  }

  template <class Body>
  static void for_each_view(const Decoder& golden, const Body& body) {
    const StreamHeader& header = golden.header();
    for (uint32_t row = 0; row < header.rows; ++row) {
      for (uint32_t col = 0; col < header.cols; ++col) body(ViewPos{row, col});
    }
  }

  // Whether the golden model has the errors that the manifest states by hand, and the checksums of
  // all other blocks.
  bool suite_agrees(const Decoder& golden) const {
    const auto is_stated = [&](const BlockAddress& block) {
      const auto decoded = golden.decode_block(block);
      return !decoded && decoded.error().code == expect_.error;
    };
    if (!std::ranges::all_of(expect_.blocks, is_stated)) return false;
    if (trial_.blocks.empty()) return true;
    const auto file = io::map_file(trial_.blocks);
    return file && std::ranges::equal(file->bytes(), vectors::expected_views(golden).blocks, {}, {},
                                      [](char c) { return static_cast<uint8_t>(c); });
  }

  Tracer tracer() {
    if (!dut_.traces()) return {};
    return [this](const BlockAddress& block, int level) { return dut_.trace(block, level); };
  }

  LineAnswer<RgbImage> view_of(const Decoder& golden, ViewPos view) {
    if (dut_.views() && !trial_.dut.by_block) return dut_.view(view);
    return assemble_view(golden, view,
                         [&](const BlockAddress& block) { return dut_.block(block, 0); });
  }

  // Compares `count` of `blocks`, spread evenly, at stop level 0, and `count_above` at each of the
  // others.
  void judge_blocks(const Decoder& golden, const BlockNumbers& blocks, uint64_t count,
                    uint64_t count_above) {
    const int top = dut_.levels() ? golden.header().tree_height : 0;
    uint64_t asked = 0;
    uint64_t wrong = 0;
    std::string first;
    std::string kind;
    for (int level = 0; level <= top; ++level) {
      const uint64_t n = std::min(blocks.count(), level == 0 ? count : count_above);
      for (uint64_t i = 0; i < n; ++i, ++asked) {
        const BlockAddress block = blocks.at(i * blocks.count() / n + static_cast<uint64_t>(level));
        const auto expected = golden.decode_block(block, {.stop_level = level});
        const auto actual = dut_.block(block, level);
        const auto what = difference_of(golden, block, expected, actual);
        if (!what || wrong++ != 0) continue;
        first =
            fmt::format("view {},{} plane {} block {},{} at stop level {}: {}", block.view.row,
                        block.view.col, plane_name(block.plane), block.bx, block.by, level, *what);
        kind = fmt::format(
            "{} of plane {} at {}",
            expected && actual ? "wrong samples"
                               : outcome_name(actual) + " instead of " + outcome_name(expected),
            plane_name(block.plane), level == 0 ? "stop level 0" : "stop levels above 0");
        if (expected && actual) result_.stage = wrong_stage(golden, block, level, tracer());
      }
    }
    if (wrong == 0) return;
    fail(fmt::format("{}; {} of {} blocks asked for", first, wrong, asked));
    result_.kind = std::move(kind);
  }

  // Views of a stream in which blocks fail: a view fails with the error of DEC-7, or decodes.
  void judge_failing_views(const Decoder& golden) {
    const StreamHeader& header = golden.header();
    const RgbImage blank{header.width, header.height, header.depth,
                         std::vector<uint16_t>(size_t{header.width} * header.height * 3)};
    std::vector<RgbImage> expected;
    std::vector<RgbImage> actual;
    for_each_view(golden, [&](ViewPos view) {
      auto right = golden.decode_view(view);
      auto answer = view_of(golden, view);
      if (outcome_name(right) != outcome_name(answer) && passes()) {
        const auto what =
            fmt::format("{} instead of {}", outcome_name(answer), outcome_name(right));
        fail(fmt::format("view {},{}: {}", view.row, view.col, what));
        result_.kind = what + " of a view";
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
  LineDecoder& dut_;
  VectorResult& result_;
};

}  // namespace

void judge_lines(const Trial& trial, const vectors::Expectation& expect,
                 const vectors::ViewSum* output, VectorResult& result) {
  using Clock = std::chrono::steady_clock;
  const VectorResult before = result;
  LineDecoders& decoders = *trial.dut.lines;
  auto dut = decoders.take();
  const auto judge_in = [&](std::unique_ptr<LineDecoder>& process, VectorResult& judged) {
    const auto begin = Clock::now();
    try {
      if (const auto handed = hand_over(trial); !handed) {
        throw LineFailure{Status::kError, handed.error().message};
      }
      if (process == nullptr) {
        process = std::make_unique<LineDecoder>(trial.dut.command, trial.limits);
      } else {
        process->allow(trial.limits.seconds);
      }
      LineJudge(trial, expect, output, *process, judged).run();
    } catch (const LineFailure& failure) {
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
  if (used && result.bad() && result.status != Status::kTimeout && decoders.is_run_again()) {
    VectorResult again = before;
    dut.reset();
    judge_in(dut, again);
    decoders.was_run_again(again.bad());
    if (!again.bad()) result.reason += " (but passes as the first stream of a process)";
  }
  if (dut != nullptr) decoders.give_back(std::move(dut));
}

}  // namespace hmlfc::conform
