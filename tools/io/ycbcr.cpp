#include "io/ycbcr.hpp"

#include <algorithm>
#include <numeric>

namespace hmlfc::io {
namespace {

// The weights of BT.709 in units of 1/5000: Y' = 0.2126 R' + 0.7152 G' + 0.0722 B',
// Cb = (B' - Y') / 1.8556, Cr = (R' - Y') / 1.5748.
constexpr int64_t kOne = 5000;
constexpr int64_t kRed = 1063;
constexpr int64_t kGreen = 3576;
constexpr int64_t kBlue = 361;
constexpr int64_t kBlueRange = 2 * (kOne - kBlue);
constexpr int64_t kRedRange = 2 * (kOne - kRed);

// numerator / denominator to the nearest integer, halves upwards; denominator > 0.
int64_t rounded_quotient(int64_t numerator, int64_t denominator) {
  const int64_t doubled = 2 * numerator + denominator;
  const int64_t quotient = doubled / (2 * denominator);
  return doubled % (2 * denominator) < 0 ? quotient - 1 : quotient;
}

// What black, white and the greatest difference of colour are.
struct Scale {
  int64_t black;
  int64_t luma;    // from black to white
  int64_t chroma;  // from the least to the greatest
  int64_t middle;  // of chroma
  int64_t most;
};

Scale scale_of(const VideoLevels& levels) {
  const int64_t most = (int64_t{1} << levels.bits) - 1;
  const int64_t middle = int64_t{1} << (levels.bits - 1);
  if (levels.full_range) return {0, most, most, middle, most};
  const int64_t step = int64_t{1} << (levels.bits - 8);
  return {16 * step, 219 * step, 224 * step, middle, most};
}

}  // namespace

// Numerators stay below 2^42.
YCbCr ycbcr_of(const Rgb& pixel, int depth, const VideoLevels& levels) {
  const Scale scale = scale_of(levels);
  const int64_t white = (int64_t{1} << depth) - 1;
  const int64_t luma = kRed * pixel.r + kGreen * pixel.g + kBlue * pixel.b;
  const auto limited = [&](int64_t value) {
    return static_cast<int32_t>(std::clamp<int64_t>(value, 0, scale.most));
  };
  const auto chroma = [&](int64_t sample, int64_t range) {
    const int64_t difference = kOne * sample - luma;
    return limited(scale.middle + rounded_quotient(scale.chroma * difference, range * white));
  };
  return {limited(scale.black + rounded_quotient(scale.luma * luma, kOne * white)),
          chroma(pixel.b, kBlueRange), chroma(pixel.r, kRedRange)};
}

// All over the least common multiple of both scales, which is below 2^24: numerators stay below
// 2^61.
Rgb rgb_of(const YCbCr& pixel, int depth, const VideoLevels& levels) {
  const Scale scale = scale_of(levels);
  const int64_t white = (int64_t{1} << depth) - 1;
  const int64_t unit = std::lcm(scale.luma, scale.chroma);
  const int64_t y = (pixel.y - scale.black) * (unit / scale.luma);
  const int64_t cb = (pixel.cb - scale.middle) * (unit / scale.chroma);
  const int64_t cr = (pixel.cr - scale.middle) * (unit / scale.chroma);
  const auto sample = [&](int64_t value, int64_t one) {
    const int64_t nearest = rounded_quotient(white * value, one * unit);
    return static_cast<int32_t>(std::clamp<int64_t>(nearest, 0, white));
  };
  const int64_t green = kGreen * kOne * y - kBlue * kBlueRange * cb - kRed * kRedRange * cr;
  return {sample(kOne * y + kRedRange * cr, kOne), sample(green, kGreen * kOne),
          sample(kOne * y + kBlueRange * cb, kOne)};
}

}  // namespace hmlfc::io
