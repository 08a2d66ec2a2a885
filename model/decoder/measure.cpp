#include <hmlfc/measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "arithmetic/colour.hpp"

namespace hmlfc {
namespace {

// Samples of whole pixels whose squares add up in 32 bits: 255 * 4095^2 < 2^32.
constexpr size_t kRun = 255;

uint32_t square(int32_t difference) { return static_cast<uint32_t>(difference * difference); }

int32_t luma(const uint16_t* pixel) { return forward_colour({pixel[0], pixel[1], pixel[2]}).y; }

}  // namespace

void ErrorSums::add(const ErrorSums& other) {
  rgb_squares += other.rgb_squares;
  y_squares += other.y_squares;
  max_abs = std::max(max_abs, other.max_abs);
}

ErrorSums measure(const RgbImage& a, const RgbImage& b) {
  ErrorSums sums;
  for (size_t from = 0; from < a.samples.size(); from += kRun) {
    const size_t to = std::min(from + kRun, a.samples.size());
    uint32_t rgb_squares = 0;
    uint32_t y_squares = 0;
    int32_t max_abs = 0;
    for (size_t i = from; i < to; ++i) {
      const int32_t difference = int32_t{a.samples[i]} - b.samples[i];
      rgb_squares += square(difference);
      max_abs = std::max(max_abs, std::abs(difference));
    }
    for (size_t i = from; i < to; i += 3) {
      y_squares += square(luma(&a.samples[i]) - luma(&b.samples[i]));
    }
    sums.rgb_squares += rgb_squares;
    sums.y_squares += y_squares;
    sums.max_abs = std::max(sums.max_abs, static_cast<uint32_t>(max_abs));
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
