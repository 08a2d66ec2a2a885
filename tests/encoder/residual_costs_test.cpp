// The cost of a block's residual against trying every bias on every value, and the estimate of it
// that motion is decided with.
#include "encoder/residual_costs.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "encoder/residual_writer.hpp"

namespace hmlfc {
namespace {

BlockValues draw_block(std::mt19937& random, unsigned size, int32_t amplitude) {
  BlockValues block(size);
  const int32_t mean = static_cast<int32_t>(random() % 21) - 10;
  for (size_t i = 0; i < block.size(); ++i) {
    block[i] = mean - amplitude +
               static_cast<int32_t>(random() % static_cast<unsigned>(2 * amplitude + 1));
  }
  return block;
}

int64_t error_of(const BlockValues& block, int32_t step, int32_t levels, int32_t bias) {
  const int32_t lo = bias - (levels >> 1);
  int64_t error = 0;
  for (const int32_t value : block.span()) {
    const int64_t left = value - step * clamp(quantized(value, step), lo, lo + levels - 1);
    error += left * left;
  }
  return error;
}

TEST(ResidualCosts, AreTheLeastOverAllBiases) {
  std::mt19937 random(2);
  const Lambda lambda{300};
  for (int round = 0; round < 200; ++round) {
    const BlockValues block = draw_block(random, round % 2 == 0 ? 4 : 2, 1 + round % 40);
    ResidualCosts weighed(block, lambda);
    const int32_t step = 1 + round % 7;
    std::array<LevelCosts, kTriedBiasBits.size()> costs;
    weighed.weigh(step, 28, costs);
    for (size_t b = 0; b < costs.size(); ++b) {
      const unsigned bits = kTriedBiasBits[b];
      for (unsigned code = 0; code < 28; ++code) {
        if (costs[b][code] == kNever) continue;
        const Levels levels = levels_of_code(code);
        const auto n = static_cast<int32_t>(levels.count);
        int64_t least = kNever;
        for (int32_t bias = -128; bias < 128; ++bias) {
          if (fits_signed(bias, bits)) least = std::min(least, error_of(block, step, n, bias));
        }
        const auto size = static_cast<int64_t>(bise_bits(levels, block.size()));
        ASSERT_EQ(costs[b][code], lambda.cost(least, size)) << "code " << code << ", bits " << bits;
        ASSERT_EQ(error_of(block, step, n, weighed.best_bias(step, code, bits)), least);
      }
    }
  }
}

TEST(ResidualEstimate, IsTheEnergyAndThenItsLogarithmWithTheirSlope) {
  for (const int64_t scaled : {256, 3000, 1 << 20}) {
    const ResidualEstimate estimate(Lambda{scaled});
    const double lambda = static_cast<double>(scaled) / 256;
    int64_t last = 0;
    for (int64_t energy = 0; energy < int64_t{1} << 30; energy += energy / 7 + 1) {
      const double least = 41 * lambda;
      const auto e = static_cast<double>(energy);
      const double expected = e <= least ? e : least + 8 * lambda * std::log2(e / least);
      ASSERT_NEAR(static_cast<double>(estimate(energy)), expected, 1 + 0.09 * 8 * lambda);
      ASSERT_GE(estimate(energy), last);
      last = estimate(energy);
      const double slope = e <= least ? 1000 : 1000 * 8 * lambda / (std::log(2.0) * e);
      ASSERT_NEAR(static_cast<double>(estimate.slope(energy, 1000)), slope, 1 + slope / 500);
    }
  }
}

}  // namespace
}  // namespace hmlfc
