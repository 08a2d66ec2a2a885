#include "encoder/residual_writer.hpp"

#include <algorithm>
#include <vector>

#include "encoder/residual_coding.hpp"

namespace hmlfc {
namespace {

ResidualInterval interval_of(const BlockValues& residual) {
  const auto values = residual.span();
  const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
  return {*lo, *hi};
}

SequenceFields values_of(const BlockValues& residual, const BlockCode& code) {
  SequenceFields sequence;
  sequence.level_code = code.level_code;
  const Levels levels = levels_of_code(code.level_code);
  for (const int32_t value : residual.span()) {
    const int32_t shifted = value - code.bias + static_cast<int32_t>(levels.count >> 1);
    sequence.values.push_back(static_cast<uint32_t>(shifted));
  }
  return sequence;
}

}  // namespace

ResidualFields residual_fields(std::span<const BlockValues* const> blocks, int depth,
                               unsigned step_code) {
  std::vector<ResidualInterval> intervals;
  for (const BlockValues* block : blocks) intervals.push_back(interval_of(*block));
  const ResidualCoding coding = best_coding(intervals, blocks.front()->size(), depth);
  ResidualFields fields;
  fields.level_base = coding.level_base;
  fields.level_bits = coding.level_bits;
  fields.bias_bits = coding.bias_bits;
  fields.step_base = step_code;
  for (size_t i = 0; i < blocks.size(); ++i) {
    const BlockCode& code = coding.blocks[i];
    fields.blocks.push_back({step_code, code.bias, values_of(*blocks[i], code)});
  }
  return fields;
}

}  // namespace hmlfc
