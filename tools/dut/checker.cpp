// hmlfc_checker.h: numbers and words of C around class Lockstep.
#include "dut/hmlfc_checker.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dut/lockstep.hpp"

namespace {

using namespace hmlfc::lockstep;

constexpr size_t kStageValues = 64;  // of a stage in a vector
constexpr unsigned kValueBits = 16;

struct Checkers {
  std::vector<std::unique_ptr<Lockstep>> all;  // checker number 1 is the first
  std::string text;                            // of the last call
};

Checkers& checkers() {
  static Checkers checkers;
  return checkers;
}

Lockstep& checker_of(int checker) { return *checkers().all.at(static_cast<size_t>(checker) - 1); }

// Tells a checker something by action(Lockstep&), and keeps its text. Returns the number of new
// differences.
template <class Action>
int told(int checker, const Action& action) {
  Lockstep& lockstep = checker_of(checker);
  const int64_t before = lockstep.differences();
  action(lockstep);
  checkers().text = lockstep.take_text();
  return static_cast<int>(lockstep.differences() - before);
}

// Value `index` of a vector of svLogicVecVal.
PinValue value_at(const unsigned* words, size_t index) {
  const size_t pair = index / 2 * 2;
  const unsigned shift = index % 2 * kValueBits;
  if ((words[pair + 1] >> shift & 0xffff) != 0) return std::nullopt;
  return static_cast<int16_t>(words[pair] >> shift & 0xffff);
}

std::vector<PinValue> values(const unsigned* words, size_t first, size_t count) {
  std::vector<PinValue> found(count);
  for (size_t i = 0; i < count; ++i) found[i] = value_at(words, first + i);
  return found;
}

int fail(const std::string& text) {
  checkers().text = text;
  return 0;
}

}  // namespace

int hmlfc_checker_open(const char* stream, const char* device, int block_log2) {
  if (block_log2 < 1 || block_log2 > 3) return fail("block_log2 is 1, 2 or 3\n");
  auto read = read_device(device);
  if (!read) {
    return fail(read.error().message + "\n+hmlfc_checker_device=FILE names the capability file\n");
  }
  if (std::ranges::count(read->claims.block_log2, static_cast<unsigned>(block_log2)) == 0) {
    return fail(
        fmt::format("{}: \"block_log2\" lacks {}, which parameter BLOCK_LOG2 of "
                    "hmlfc_checker names: mend either\n",
                    device, block_log2));
  }
  auto model = Model::open(stream, read->checks_sections);
  if (!model) {
    return fail(model.error().message + "\n+hmlfc_checker_stream=FILE names the stream\n");
  }
  auto& all = checkers().all;
  all.push_back(std::make_unique<Lockstep>(std::move(*model), std::move(*read), stream,
                                           static_cast<unsigned>(block_log2)));
  checkers().text = all.back()->take_text();
  return static_cast<int>(all.size());
}

const char* hmlfc_checker_text(int) { return checkers().text.c_str(); }

int hmlfc_checker_request(int checker, long long clock, int row, int col, int plane, int block_x,
                          int block_y, int stop_level, int tag) {
  return told(checker, [&](Lockstep& lockstep) {
    lockstep.request(clock, {row, col, plane, block_x, block_y, stop_level}, tag);
  });
}

int hmlfc_checker_answer(int checker, long long clock, int tag, int status,
                         const unsigned* samples) {
  return told(checker, [&](Lockstep& lockstep) {
    lockstep.answer(clock, {tag, status, values(samples, 0, kLanes * lockstep.lane())});
  });
}

int hmlfc_checker_stage(int checker, long long clock, int row, int col, int plane, int block_x,
                        int block_y, int level, int error, int shown, const unsigned* words) {
  Record record;
  record.site.level = level;
  record.site.image_row = static_cast<uint32_t>(row);
  record.site.image_col = static_cast<uint32_t>(col);
  record.site.plane = static_cast<hmlfc::Plane>(plane);
  record.site.bx = static_cast<uint32_t>(block_x);
  record.site.by = static_cast<uint32_t>(block_y);
  record.error = error;
  record.shown = static_cast<unsigned>(shown);
  return told(checker, [&](Lockstep& lockstep) {
    for (size_t i = 0; i < record.values.size(); ++i) {
      record.values[i] = values(words, i * kStageValues, lockstep.lane());
    }
    lockstep.record(clock, record);
  });
}

int hmlfc_checker_unknown(int checker, long long clock, const char* where) {
  return told(checker, [&](Lockstep& lockstep) { lockstep.unknown(clock, where); });
}

void hmlfc_checker_reset(int checker, long long) { checker_of(checker).reset(); }

int hmlfc_checker_end(int checker, long long clock, int complete) {
  Lockstep& lockstep = checker_of(checker);
  bool first = false;
  told(checker, [&](Lockstep&) { first = lockstep.end(clock, complete != 0); });
  if (!first) return 0;
  if (lockstep.differences() != 0) return static_cast<int>(lockstep.differences());
  return lockstep.compared_something() ? 0 : -1;
}

int hmlfc_checker_expected(int checker, int row, int col, int plane, int block_x, int block_y,
                           int stop_level, unsigned* samples) {
  const Lockstep& lockstep = checker_of(checker);
  const Expectation expected =
      lockstep.model().expect({row, col, plane, block_x, block_y, stop_level}, false);
  std::fill_n(samples, HMLFC_CHECKER_ANSWER_BITS / 32 * 2, 0u);
  for (size_t i = 0; i < expected.samples.size(); ++i) {
    samples[i / 2 * 2] |= (static_cast<unsigned>(expected.samples[i]) & 0xffff)
                          << i % 2 * kValueBits;
  }
  return expected.status;
}
