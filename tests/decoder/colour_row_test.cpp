// Rows of pixels on every instruction set against COL-1 and COL-2 on each.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "arithmetic/colour.hpp"
#include "arithmetic/widths.hpp"
#include "decoder/colour_row.hpp"
#include "support/instruction_sets.hpp"

namespace hmlfc {
namespace {

int16_t draw(std::mt19937& random, Plane plane, int depth) {
  const SampleRange range = sample_range(plane, depth);
  const auto size = static_cast<uint32_t>(range.hi - range.lo + 1);
  return static_cast<int16_t>(range.lo + static_cast<int32_t>(random() % size));
}

void check_row(std::mt19937& random, size_t pixels, bool halved, int depth) {
  std::vector<int16_t> y(pixels), co(pixels), cg(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    y[i] = draw(random, Plane::kY, depth);
    co[i] = draw(random, Plane::kCo, depth);
    cg[i] = draw(random, Plane::kCg, depth);
  }
  const ColourRow row{y.data(), co.data(), cg.data(), pixels, halved, depth};
  constexpr uint8_t kUntouched = 0xA5;
  std::vector<uint16_t> rgb(pixels * 3 + 1, kUntouched);
  std::vector<uint16_t> rgbx16(pixels * 4 + 1, kUntouched);
  std::vector<uint8_t> rgbx8(pixels * 4 + 1, kUntouched);
  write_rgb(row, rgb.data());
  write_rgbx(row, rgbx16.data());
  if (depth == 8) write_rgbx(row, rgbx8.data());
  for (size_t i = 0; i < pixels; ++i) {
    const size_t c = halved ? i / 2 : i;
    const Rgb expected = inverse_colour({y[i], co[c], cg[c]}, depth);
    const int32_t channels[] = {expected.r, expected.g, expected.b, 0};
    for (size_t k = 0; k < 4; ++k) {
      if (k < 3) {
        ASSERT_EQ(rgb[3 * i + k], channels[k]);
      }
      ASSERT_EQ(rgbx16[4 * i + k], channels[k]);
      if (depth == 8) {
        ASSERT_EQ(rgbx8[4 * i + k], channels[k]);
      }
    }
  }
  EXPECT_EQ(rgb.back(), kUntouched);
  EXPECT_EQ(rgbx16.back(), kUntouched);
  EXPECT_EQ(rgbx8.back(), kUntouched);
}

void check_samples(std::mt19937& random, size_t pixels, int depth) {
  std::vector<uint16_t> rgb(3 * pixels);
  for (uint16_t& sample : rgb) sample = static_cast<uint16_t>(random() % (1u << depth));
  constexpr int16_t kUntouched = -12345;
  std::vector<int16_t> y(pixels + 1, kUntouched), co(y), cg(y);
  read_rgb(rgb.data(), pixels, y.data(), co.data(), cg.data());
  for (size_t i = 0; i < pixels; ++i) {
    const YCoCg expected = forward_colour({rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
    ASSERT_EQ((YCoCg{y[i], co[i], cg[i]}), expected);
  }
  EXPECT_TRUE(y.back() == kUntouched && co.back() == kUntouched && cg.back() == kUntouched);
}

TEST(ColourRow, EqualsTheTransforms) {
  for (const int64_t target : test::instruction_sets()) {
    const test::ChosenInstructionSet chosen(target);
    std::mt19937 random(1);
    for (int depth = 8; depth <= 12; ++depth) {
      for (size_t pixels = 1; pixels < 70; ++pixels) {
        check_row(random, pixels, false, depth);
        check_row(random, pixels, true, depth);
        check_samples(random, pixels, depth);
      }
    }
  }
}

}  // namespace
}  // namespace hmlfc
