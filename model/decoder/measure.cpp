#include <hmlfc/measure.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "decoder/colour_row.hpp"

namespace hmlfc {
namespace {

// Pixels whose squares add up in 31 bits: 3 * 42 * 4095^2 < 2^31.
constexpr size_t kRun = 42;

}  // namespace

void ErrorSums::add(const ErrorSums& other) {
  rgb_squares += other.rgb_squares;
  y_squares += other.y_squares;
  max_abs = std::max(max_abs, other.max_abs);
}

ErrorSums measure(const RgbImage& a, const RgbImage& b) {
  ErrorSums sums;
  std::array<int16_t, kRun> y0, y1, co, cg;
  for (size_t from = 0; from < a.samples.size(); from += 3 * kRun) {
    const size_t pixels = std::min(kRun, (a.samples.size() - from) / 3);
    const uint16_t* rgb0 = &a.samples[from];
    const uint16_t* rgb1 = &b.samples[from];
    read_rgb(rgb0, pixels, y0.data(), co.data(), cg.data());
    read_rgb(rgb1, pixels, y1.data(), co.data(), cg.data());
    int32_t rgb_squares = 0;
    int32_t y_squares = 0;
    int16_t least = 0;
    int16_t most = 0;
    for (size_t i = 0; i < 3 * pixels; ++i) {
      const auto difference = static_cast<int16_t>(rgb0[i] - rgb1[i]);
      rgb_squares += difference * difference;
      least = std::min(least, difference);
      most = std::max(most, difference);
    }
    for (size_t i = 0; i < pixels; ++i) {
      const auto difference = static_cast<int16_t>(y0[i] - y1[i]);
      y_squares += difference * difference;
    }
    sums.rgb_squares += static_cast<uint32_t>(rgb_squares);
    sums.y_squares += static_cast<uint32_t>(y_squares);
    sums.max_abs =
        std::max({sums.max_abs, static_cast<uint32_t>(most), static_cast<uint32_t>(-least)});
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
