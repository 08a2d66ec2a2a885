#include <hmlfc/measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "arithmetic/colour.hpp"

namespace hmlfc {
namespace {

uint64_t square(int32_t difference) {
  return static_cast<uint64_t>(int64_t{difference} * difference);
}

int32_t luma(const uint16_t* pixel) { return forward_colour({pixel[0], pixel[1], pixel[2]}).y; }

}  // namespace

void ErrorSums::add(const ErrorSums& other) {
  rgb_squares += other.rgb_squares;
  y_squares += other.y_squares;
  max_abs = std::max(max_abs, other.max_abs);
}

ErrorSums measure(const RgbImage& a, const RgbImage& b) {
  ErrorSums sums;
  for (size_t i = 0; i < a.samples.size(); i += 3) {
    for (size_t channel = i; channel < i + 3; ++channel) {
      const int32_t difference = int32_t{a.samples[channel]} - b.samples[channel];
      sums.rgb_squares += square(difference);
      sums.max_abs = std::max(sums.max_abs, static_cast<uint32_t>(std::abs(difference)));
    }
    sums.y_squares += square(luma(&a.samples[i]) - luma(&b.samples[i]));
  }
  return sums;
}

double psnr(uint64_t squares, uint64_t samples, int depth) {
  if (squares == 0) return std::numeric_limits<double>::infinity();
  const double peak = static_cast<double>((1 << depth) - 1);
  const double mean = static_cast<double>(squares) / static_cast<double>(samples);
  return 10.0 * std::log10(peak * peak / mean);
}

}  // namespace hmlfc
