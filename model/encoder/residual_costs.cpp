#include "encoder/residual_costs.hpp"

#include <algorithm>

#include "encoder/residual_writer.hpp"

namespace hmlfc {
ResidualCosts::ResidualCosts(const BlockValues& differences, Lambda lambda)
    : lambda_(lambda), count_(differences.size()) {
  const auto values = differences.span();
  std::copy(values.begin(), values.end(), sorted_.begin());
  std::sort(sorted_.begin(), sorted_.begin() + static_cast<ptrdiff_t>(count_));
  sums_[0] = squares_[0] = errors_[0] = 0;
  for (size_t i = 0; i < count_; ++i) {
    sums_[i + 1] = sums_[i] + sorted_[i];
    squares_[i + 1] = squares_[i] + int64_t{sorted_[i]} * sorted_[i];
  }
}

unsigned ResidualCosts::weigh(int32_t step, unsigned codes, std::span<LevelCosts> costs) {
  quantize(step);
  for (LevelCosts& row : costs) row.fill(kNever);
  int64_t least = zero();
  int32_t bias = mean();
  for (unsigned code = 0; code < codes; ++code) {
    const Levels levels = levels_of_code(code);
    const auto bits = static_cast<int64_t>(bise_bits(levels, count_));
    // A code whose bits alone cost more than the cheapest so far is skipped.
    if (lambda_.cost(0, bits) > least) return code;
    const auto n = static_cast<int32_t>(levels.count);
    bias = least_bias(n, kTriedBiasBits[costs.size() - 1], bias);
    for (size_t b = costs.size(); b > 0; --b) {
      const bool alike = b < costs.size() && fits_signed(bias, kTriedBiasBits[b - 1]);
      const int32_t lo = lowest_level(levels.count) + nearest_signed(bias, kTriedBiasBits[b - 1]);
      costs[b - 1][code] = alike ? costs[b][code] : lambda_.cost(error(lo, lo + n - 1), bits);
    }
    least = std::min(least, costs.back()[code]);
  }
  return codes;
}

int32_t ResidualCosts::best_bias(int32_t step, unsigned level_code, unsigned bias_bits) {
  quantize(step);
  return least_bias(static_cast<int32_t>(levels_of_code(level_code).count), bias_bits, mean());
}

// The first bias of `bias_bits` bits with the least error, which is convex in the bias: down and up
// from `guess`.
int32_t ResidualCosts::least_bias(int32_t levels, unsigned bias_bits, int32_t guess) const {
  const auto [first, last] = useful_biases(levels, bias_bits);
  const auto error_with = [&](int32_t bias) {
    const int32_t lo = lowest_level(static_cast<uint32_t>(levels)) + bias;
    return error(lo, lo + levels - 1);
  };
  int32_t best = clamp(guess, first, last);
  int64_t least = error_with(best);
  for (int64_t next = 0; best > first && (next = error_with(best - 1)) <= least; --best) {
    least = next;
  }
  for (int64_t next = 0; best < last && (next = error_with(best + 1)) < least; ++best) {
    least = next;
  }
  return best;
}

void ResidualCosts::quantize(int32_t step) {
  if (step == step_) return;
  step_ = step;
  for (size_t i = 0; i < count_; ++i) {
    levels_[i] = quantized(sorted_[i], step);
    const int64_t left = sorted_[i] - int64_t{levels_[i]} * step;
    errors_[i + 1] = errors_[i] + left * left;
  }
}

// The biases with which N levels reach from the lowest to the highest value, or 0 if one will do;
// always with 0, of `bias_bits` bits.
ResidualCosts::Biases ResidualCosts::useful_biases(int32_t levels, unsigned bias_bits) const {
  const int32_t lowest = lowest_level(static_cast<uint32_t>(levels));
  int32_t first = levels_[0] - lowest;
  int32_t last = levels_[count_ - 1] - (levels - 1) - lowest;
  // Some biases reach all values: the one nearest to 0.
  if (last <= first) first = last = clamp(0, last, first);
  return {nearest_signed(std::min(first, 0), bias_bits),
          nearest_signed(std::max(last, 0), bias_bits)};
}

// The squared error of values that are clamped to levels [lo, hi].
int64_t ResidualCosts::error(int32_t lo, int32_t hi) const {
  const auto begin = levels_.begin();
  const auto end = begin + static_cast<ptrdiff_t>(count_);
  const auto first = static_cast<size_t>(std::lower_bound(begin, end, lo) - begin);
  const auto last = static_cast<size_t>(std::upper_bound(begin, end, hi) - begin);
  return moved(0, first, int64_t{lo} * step_) + errors_[last] - errors_[first] +
         moved(last, count_, int64_t{hi} * step_);
}

// The squared error of sorted values [first, last) that become `value`.
int64_t ResidualCosts::moved(size_t first, size_t last, int64_t value) const {
  const auto n = static_cast<int64_t>(last - first);
  return squares_[last] - squares_[first] - 2 * value * (sums_[last] - sums_[first]) +
         n * value * value;
}

}  // namespace hmlfc
