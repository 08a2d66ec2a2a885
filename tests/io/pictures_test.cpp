#include <gtest/gtest.h>

#include <vector>

#include "io/pictures.hpp"

namespace hmlfc::io {
namespace {

// The sheet of views in which red is 1 + x, green 10 * (row * cols + col), blue y.
RgbImage numbered_sheet(const LightFieldShape& shape, uint32_t max_width) {
  auto sheet = ContactSheet::make(shape, max_width).value();
  for (uint32_t number = 0; number < shape.rows * shape.cols; ++number) {
    RgbImage view{shape.width, shape.height, shape.depth, {}};
    for (uint32_t y = 0; y < shape.height; ++y) {
      for (uint32_t x = 0; x < shape.width; ++x) {
        view.samples.push_back(static_cast<uint16_t>(1 + x));
        view.samples.push_back(static_cast<uint16_t>(10 * number));
        view.samples.push_back(static_cast<uint16_t>(y));
      }
    }
    sheet.draw(number / shape.cols, number % shape.cols, view);
  }
  return sheet.image();
}

std::vector<uint16_t> pixel(const RgbImage& image, size_t x, size_t y) {
  const auto first = image.samples.begin() + static_cast<ptrdiff_t>((y * image.width + x) * 3);
  return {first, first + 3};
}

using Pixel = std::vector<uint16_t>;

TEST(ContactSheet, AveragesBoxesWithHalvesUp) {
  const RgbImage sheet = numbered_sheet({2, 3, 5, 4, 8}, 18);
  ASSERT_EQ(sheet.width, 13u);  // boxes of 2 x 2: three columns a view, the last one narrow
  ASSERT_EQ(sheet.height, 6u);
  EXPECT_EQ(pixel(sheet, 0, 0), (Pixel{2, 0, 1}));           // red (1 + 2) / 2, blue (0 + 1) / 2
  EXPECT_EQ(pixel(sheet, 2, 1), (Pixel{5, 0, 3}));           // red of the last column alone
  EXPECT_EQ(pixel(sheet, 5 + 1, 4 + 1), (Pixel{4, 40, 3}));  // red (3 + 4) / 2
}

TEST(ContactSheet, StopsAtOnePixelAView) {
  const RgbImage sheet = numbered_sheet({2, 3, 5, 4, 10}, 1);
  EXPECT_EQ(sheet.width, 7u);
  EXPECT_EQ(sheet.height, 4u);
  EXPECT_EQ(sheet.depth, 10);
  EXPECT_EQ(pixel(sheet, 0, 0), (Pixel{3, 0, 2}));  // blue (0 + 1 + 2 + 3) / 4 = 1.5
}

TEST(ContactSheet, IsRefusedWhereItIsTooLarge) {
  EXPECT_TRUE(ContactSheet::make({2731, 2731, 8, 8, 8}, 1600).has_value());  // 8191 x 8191
  EXPECT_FALSE(ContactSheet::make({2732, 2732, 8, 8, 8}, 1600).has_value());
}

TEST(DifferencePicture, ScalesDeepSamplesDownwards) {
  const RgbImage a{1, 1, 10, {10, 10, 10}};
  const RgbImage b{1, 1, 10, {9, 11, 5}};
  // 1 * 3 / 4 = 0.75 -> 0, -3 / 4 -> -1, 15 / 4 -> 3
  EXPECT_EQ(difference_picture(a, b, 3)->samples, (Pixel{128, 127, 131}));
}

TEST(DifferencePicture, RefusesPicturesThatDoNotMatch) {
  const RgbImage a{1, 1, 8, {0, 0, 0}};
  EXPECT_FALSE(difference_picture(a, {1, 1, 9, {0, 0, 0}}, 1).has_value());
  EXPECT_FALSE(difference_picture(a, {2, 1, 8, {0, 0, 0, 0, 0, 0}}, 1).has_value());
  EXPECT_FALSE(difference_picture(a, {1, 2, 8, {0, 0, 0, 0, 0, 0}}, 1).has_value());
}

}  // namespace
}  // namespace hmlfc::io
