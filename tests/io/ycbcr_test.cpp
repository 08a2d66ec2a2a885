// R, G, B to Y', Cb, Cr and back, against real arithmetic and over whole intervals.
#include "io/ycbcr.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

namespace hmlfc::io {
namespace {

// BT.709 as it is defined, in real numbers: black 0, white 1.
std::array<double, 3> defined(const Rgb& pixel, int depth, const VideoLevels& levels) {
  const double white = std::ldexp(1, depth) - 1;
  const double r = pixel.r / white;
  const double g = pixel.g / white;
  const double b = pixel.b / white;
  const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  const double most = std::ldexp(1, levels.bits) - 1;
  const double step = std::ldexp(1, levels.bits - 8);
  const double luma = levels.full_range ? most : 219 * step;
  const double chroma = levels.full_range ? most : 224 * step;
  const double black = levels.full_range ? 0 : 16 * step;
  return {black + luma * y, std::fmin(most, 128 * step + chroma * (b - y) / 1.8556),
          std::fmin(most, 128 * step + chroma * (r - y) / 1.5748)};
}

Rgb pixel_of(int depth) {
  const auto sample = rc::gen::inRange(0, 1 << depth);
  return {*sample, *sample, *sample};
}

RC_GTEST_PROP(YCbCrProperty, IsTheNearestToTheDefinition, ()) {
  const int depth = *rc::gen::inRange(8, 13);
  const VideoLevels levels{*rc::gen::element(8, 9, 10, 12, 14, 16), *rc::gen::arbitrary<bool>()};
  const Rgb pixel = pixel_of(depth);
  const YCbCr found = ycbcr_of(pixel, depth, levels);
  const auto wanted = defined(pixel, depth, levels);
  RC_ASSERT(std::abs(found.y - wanted[0]) <= 0.5 + 1e-9);
  RC_ASSERT(std::abs(found.cb - wanted[1]) <= 0.5 + 1e-9);
  RC_ASSERT(std::abs(found.cr - wanted[2]) <= 0.5 + 1e-9);
}

RC_GTEST_PROP(YCbCrProperty, TwoMoreBitsKeepEveryDepth, ()) {
  const int depth = *rc::gen::inRange(8, 13);
  const VideoLevels levels{depth + 2, *rc::gen::arbitrary<bool>()};
  const Rgb pixel = pixel_of(depth);
  RC_ASSERT(rgb_of(ycbcr_of(pixel, depth, levels), depth, levels) == pixel);
}

// By the definition in exact fractions.
TEST(YCbCr, KnownColours) {
  EXPECT_EQ(ycbcr_of({0, 0, 0}, 8, {8, false}), (YCbCr{16, 128, 128}));
  EXPECT_EQ(ycbcr_of({255, 255, 255}, 8, {8, false}), (YCbCr{235, 128, 128}));
  EXPECT_EQ(ycbcr_of({255, 0, 0}, 8, {8, false}), (YCbCr{63, 102, 240}));
  EXPECT_EQ(ycbcr_of({0, 0, 255}, 8, {10, false}), (YCbCr{127, 960, 471}));
  EXPECT_EQ(ycbcr_of({0, 0, 4095}, 12, {14, true}).cb, 16383);
  EXPECT_EQ(rgb_of({0, 0, 0}, 8, {8, false}), (Rgb{0, 77, 0}));
  EXPECT_EQ(rgb_of({16383, 16383, 16383}, 12, {14, false}), (Rgb{4095, 2954, 4095}));
}

}  // namespace
}  // namespace hmlfc::io
