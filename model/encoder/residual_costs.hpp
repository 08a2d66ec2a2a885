// Weighs what one block costs with each way of coding its residual (TIL-8, STP-1).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "arithmetic/bise.hpp"
#include "decoder/sample_plane.hpp"
#include "encoder/rate_distortion.hpp"

namespace hmlfc {

/// The level codes of samples of 12 bits; samples of 8 bits have 28.
inline constexpr unsigned kLevelCodes = max_residual_level_code(12) + 1;

/// The widths of the field bias that are tried: with steps, the first four.
inline constexpr std::array<unsigned, 8> kTriedBiasBits{0, 2, 3, 4, 5, 6, 7, 8};
inline constexpr size_t kBiasWidthsOfSteps = 4;

/// More than any cost, and so little that 64 of them can be added.
inline constexpr int64_t kNever = std::numeric_limits<int64_t>::max() / 1024;

/// Costs by level code; kNever where a code is not worth trying.
using LevelCosts = std::array<int64_t, kLevelCodes>;

/// Nearest multiple of `step` > 0, halves towards 0.
constexpr int32_t quantized(int32_t value, int32_t step) {
  const int32_t magnitude = (2 * (value < 0 ? -value : value) + step - 1) / (2 * step);
  return value < 0 ? -magnitude : magnitude;
}

/// The level count N >= 1 as an interval: without bias, values lie in [lowest_level(N),
/// lowest_level(N) + N - 1] (TIL-10).
constexpr int32_t lowest_level(uint32_t count) { return -static_cast<int32_t>(count >> 1); }

/// The differences (original less prediction) of one block, weighed. A value outside the levels of
/// a code takes the nearest one.
class ResidualCosts {
 public:
  ResidualCosts(const BlockValues& differences, Lambda lambda);

  /// D + lambda R without a residual.
  int64_t zero() const { return lambda_.cost(squares_[count_], 0); }

  /// D + lambda R of the block values alone, with `step`: the least for each level code below
  /// `codes`, for the first costs.size() in [1, 8] of kTriedBiasBits. Returns the number of codes
  /// that may be worth trying; from there on costs are kNever.
  unsigned weigh(int32_t step, unsigned codes, std::span<LevelCosts> costs);

  /// The bias of `bias_bits` bits in [0, 8] with the least error; the first of equal ones.
  int32_t best_bias(int32_t step, unsigned level_code, unsigned bias_bits);

 private:
  struct Biases {
    int32_t first;
    int32_t last;
  };

  void quantize(int32_t step);
  // Of the values, about, in steps.
  int32_t mean() const {
    return static_cast<int32_t>(sums_[count_] / static_cast<int64_t>(count_)) / step_;
  }
  int32_t least_bias(int32_t levels, unsigned bias_bits, int32_t guess) const;
  Biases useful_biases(int32_t levels, unsigned bias_bits) const;
  int64_t error(int32_t lo, int32_t hi) const;
  int64_t moved(size_t first, size_t last, int64_t value) const;

  static constexpr size_t kMaxSamples = size_t{kMaxBlockSize} * kMaxBlockSize;

  Lambda lambda_;
  size_t count_;
  int32_t step_ = 0;
  // The first count_ have a value.
  std::array<int32_t, kMaxSamples> sorted_;
  std::array<int32_t, kMaxSamples> levels_;  // of sorted_ with step_
  // Sums of the first k of them.
  std::array<int64_t, kMaxSamples + 1> sums_;
  std::array<int64_t, kMaxSamples + 1> squares_;
  std::array<int64_t, kMaxSamples + 1> errors_;
};

}  // namespace hmlfc
