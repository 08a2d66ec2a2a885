// Every kind of PNG that is read, and the PNG that is written.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "io/image_files.hpp"
#include "io/sample_images.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using test::Bytes;
using test::make_png;
using test::PngContent;
using Samples = std::vector<uint16_t>;

class PngTest : public testing::Test {
 protected:
  RgbImage read(const PngContent& content) {
    test::put_file(folder_ / "a.png", make_png(content));
    const auto image = read_image(folder_ / "a.png");
    EXPECT_TRUE(image.has_value()) << image.error().message;
    return image.value_or(RgbImage{});
  }

  test::TempFolder folder_;
};

TEST_F(PngTest, WritesAndReadsEveryDepthExactly) {
  for (int depth = 8; depth <= 12; ++depth) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 2u}, {64u, 33u}, {1u, 50u}}) {
      const RgbImage image = test::random_image(width, height, depth, width + height);
      ASSERT_TRUE(write_png(folder_ / "a.png", image));
      const auto again = read_image(folder_ / "a.png");
      ASSERT_TRUE(again) << again.error().message;
      EXPECT_EQ(again->width, width);
      EXPECT_EQ(again->height, height);
      EXPECT_EQ(again->depth, depth);
      EXPECT_EQ(again->samples, image.samples) << "depth " << depth;
    }
  }
}

TEST_F(PngTest, DeepSamplesFillThe16BitsOfTheFile) {
  ASSERT_TRUE(write_png(folder_ / "a.png", {1, 1, 10, {0, 1023, 0x2AF}}));
  const Bytes ten = test::stored_rows(test::get_file(folder_ / "a.png"));
  EXPECT_EQ(ten, (Bytes{0x00, 0x00, 0xFF, 0xFF, 0xAB, 0xEA}));  // 10101011 11|101010
  ASSERT_TRUE(write_png(folder_ / "a.png", {1, 1, 12, {1, 4095, 0x801}}));
  const Bytes twelve = test::stored_rows(test::get_file(folder_ / "a.png"));
  EXPECT_EQ(twelve, (Bytes{0x00, 0x10, 0xFF, 0xFF, 0x80, 0x18}));
}

TEST_F(PngTest, DropsAlphaAndStretchesGrey) {
  const std::vector<std::pair<PngContent, Samples>> cases = {
      {{.colour_type = 6, .rows = {9, 8, 7, 0}}, {9, 8, 7}},
      {{.width = 2, .colour_type = 4, .rows = {50, 255, 60, 1}}, {50, 50, 50, 60, 60, 60}},
      {{.bit_depth = 16, .colour_type = 6, .rows = {0x12, 0x3F, 0x45, 0x60, 0xFF, 0xFF, 0, 0}},
       {0x123, 0x456, 0xFFF}},
      {{.width = 2, .colour_type = 0, .rows = {0, 200}}, {0, 0, 0, 200, 200, 200}},
      {{.width = 3, .bit_depth = 1, .colour_type = 0, .rows = {0xA0}},
       {255, 255, 255, 0, 0, 0, 255, 255, 255}},
      {{.width = 4, .bit_depth = 2, .colour_type = 0, .rows = {0x1B}},
       {0, 0, 0, 85, 85, 85, 170, 170, 170, 255, 255, 255}},
      {{.width = 2, .bit_depth = 4, .colour_type = 0, .rows = {0x3F}}, {51, 51, 51, 255, 255, 255}},
  };
  for (const auto& [content, expected] : cases) EXPECT_EQ(read(content).samples, expected);
}

TEST_F(PngTest, LooksPalettesUpWithAndWithoutTransparency) {
  PngContent content{.width = 3, .height = 1, .colour_type = 3, .rows = {2, 0, 1}};
  content.palette = {10, 20, 30, 40, 50, 60, 70, 80, 90};
  const Samples expected = {70, 80, 90, 10, 20, 30, 40, 50, 60};
  EXPECT_EQ(read(content).samples, expected);
  content.palette_alpha = {0, 128};
  EXPECT_EQ(read(content).samples, expected);
  content.bit_depth = 2;
  content.rows = {0x84};
  EXPECT_EQ(read(content).samples, expected);
}

TEST_F(PngTest, TakesTheDepthOf16BitsFromSignificantBits) {
  struct Case {
    Bytes significant;  // none if empty
    int depth;
    uint16_t sample;  // of the value 0xABCD
  };
  const std::vector<Case> cases = {
      {Bytes{}, 12, 0xABC},           {Bytes{12, 12, 12}, 12, 0xABC},
      {Bytes{11, 11, 11}, 11, 0x55E}, {Bytes{10, 10, 10}, 10, 0x2AF},
      {Bytes{9, 9, 9}, 9, 0x157},     {Bytes{8, 8, 8}, 8, 0xAB},
      {Bytes{5, 6, 5}, 8, 0xAB},      {Bytes{16, 16, 16}, 12, 0xABC},
      {Bytes{9, 11, 10}, 11, 0x55E},
  };
  for (const Case& c : cases) {
    PngContent content{.bit_depth = 16, .rows = {0xAB, 0xCD, 0xAB, 0xCD, 0xAB, 0xCD}};
    content.significant = c.significant;
    const RgbImage image = read(content);
    EXPECT_EQ(image.depth, c.depth);
    EXPECT_EQ(image.samples, Samples(3, c.sample)) << "depth " << c.depth;
  }
}

TEST_F(PngTest, TakesTheDepthOfGreyFromItsOwnSignificantBits) {
  PngContent content{.bit_depth = 16, .colour_type = 0, .rows = {0xAB, 0xCD}};
  content.significant = Bytes{10};
  EXPECT_EQ(read(content).samples, Samples(3, 0x2AF));
}

TEST_F(PngTest, ReadsInterlacedPictures) {
  for (const int bits : {8, 16}) {
    PngContent content{.width = 13, .height = 11, .bit_depth = bits, .interlaced = true};
    const RgbImage image = test::random_image(13, 11, 8, 3);
    for (const uint16_t sample : image.samples) {
      content.rows.push_back(static_cast<uint8_t>(sample));
      if (bits == 16) content.rows.push_back(0);
    }
    Samples expected = image.samples;
    if (bits == 16) {
      for (uint16_t& sample : expected) sample = static_cast<uint16_t>(sample * 16);
    }
    EXPECT_EQ(read(content).samples, expected) << bits;
  }
}

}  // namespace
}  // namespace hmlfc::io
