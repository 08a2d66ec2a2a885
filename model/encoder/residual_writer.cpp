#include "encoder/residual_writer.hpp"

#include <algorithm>
#include <vector>

#include "encoder/residual_coding.hpp"
#include "values/bise.hpp"

namespace hmlfc {
namespace {

ResidualInterval interval_of(const BlockValues& residual) {
  const auto values = residual.span();
  const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
  return {*lo, *hi};
}

void put_values(BitWriter& writer, const BlockValues& residual, const BlockCode& code) {
  const Levels levels = levels_of_code(code.level_code);
  std::vector<uint32_t> values;
  for (const int32_t value : residual.span()) {
    const int32_t shifted = value - code.bias + static_cast<int32_t>(levels.count >> 1);
    values.push_back(static_cast<uint32_t>(shifted));
  }
  bise_put(writer, levels, values);
}

}  // namespace

void put_residual_blocks(BitWriter& writer, std::span<const BlockValues* const> blocks, int depth,
                         std::optional<unsigned> step_code) {
  std::vector<ResidualInterval> intervals;
  for (const BlockValues* block : blocks) intervals.push_back(interval_of(*block));
  const ResidualCoding coding = best_coding(intervals, blocks.front()->size(), depth);
  writer.put(coding.level_base, 6);
  writer.put(coding.level_bits, 3);
  writer.put(coding.bias_bits, 4);
  if (step_code) {
    writer.put(*step_code, 4);
    writer.put(0, 2);
  }
  for (const BlockCode& block : coding.blocks) {
    writer.put(block.level_code - coding.level_base, coding.level_bits);
    writer.put_signed(block.bias, coding.bias_bits);
  }
  for (size_t i = 0; i < blocks.size(); ++i) put_values(writer, *blocks[i], coding.blocks[i]);
}

}  // namespace hmlfc
