#include "conform/block_judge.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "conform/stage_trace.hpp"
#include "io/files.hpp"
#include "vectors/expected.hpp"

namespace hmlfc::conform {
namespace {

// How a block's answer differs from the golden model's inside the plane; nothing if it does not.
std::optional<std::string> difference_of(const Decoder& golden, const BlockAddress& block,
                                         const Result<std::vector<int32_t>>& expected,
                                         const DutAnswer<std::vector<int32_t>>& actual) {
  if (outcome_name(expected) != outcome_name(actual)) {
    return fmt::format("{} instead of {}", outcome_name(actual), outcome_name(expected));
  }
  if (!expected) return std::nullopt;
  return first_wrong_value(golden, block.plane, block.bx, block.by, *expected, *actual);
}

}  // namespace

void judge_blocks(const Decoder& golden, RunningDut& dut, const Tracer& tracer, BlockCounts counts,
                  VectorResult& result) {
  std::vector<BlockAddress> blocks;
  vectors::for_each_block(golden, [&](const BlockAddress& block) { blocks.push_back(block); });
  const int top = dut.can().levels ? golden.header().tree_height : 0;
  uint64_t asked = 0;
  uint64_t wrong = 0;
  std::string first;
  for (int level = 0; level <= top; ++level) {
    const uint64_t n =
        std::min<uint64_t>(blocks.size(), level == 0 ? counts.at_level_0 : counts.at_each_above);
    for (uint64_t i = 0; i < n; ++i, ++asked) {
      const uint64_t number = i * blocks.size() / n + static_cast<uint64_t>(level);
      const BlockAddress& block = blocks[number % blocks.size()];
      const auto expected = golden.decode_block(block, {.stop_level = level});
      const auto actual = dut.block(block, level);
      const auto what = difference_of(golden, block, expected, actual);
      if (!what || wrong++ != 0) continue;
      first =
          fmt::format("view {},{} plane {} block {},{} at stop level {}: {}", block.view.row,
                      block.view.col, plane_name(block.plane), block.bx, block.by, level, *what);
      result.kind =
          fmt::format("{} of plane {} at {}", expected && actual ? "wrong samples" : *what,
                      plane_name(block.plane), level == 0 ? "stop level 0" : "stop levels above 0");
      if (expected && actual) result.stage = wrong_stage(golden, block, level, tracer);
    }
  }
  if (wrong == 0) return;
  result.status = Status::kFail;
  result.reason = fmt::format("{}; {} of {} blocks asked for", first, wrong, asked);
}

bool suite_agrees(const Decoder& golden, const vectors::Expectation& expect,
                  const std::filesystem::path& blocks) {
  const auto is_stated = [&](const BlockAddress& block) {
    const auto decoded = golden.decode_block(block);
    return !decoded && decoded.error().code == expect.error;
  };
  if (!std::ranges::all_of(expect.blocks, is_stated)) return false;
  if (blocks.empty()) return true;
  const auto file = io::map_file(blocks);
  return file && std::ranges::equal(file->bytes(), vectors::expected_views(golden).blocks, {}, {},
                                    [](char c) { return static_cast<uint8_t>(c); });
}

}  // namespace hmlfc::conform
