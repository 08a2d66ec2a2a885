#include "io/view_mosaic.hpp"

#include <gtest/gtest.h>

namespace hmlfc::io {
namespace {

// A picture whose red samples are the letters of `rows`.
RgbImage picture_of(const std::vector<std::string>& rows) {
  RgbImage picture{
      static_cast<uint32_t>(rows.front().size()), static_cast<uint32_t>(rows.size()), 8, {}};
  for (const std::string& row : rows) {
    for (const char letter : row) {
      picture.samples.insert(picture.samples.end(), {static_cast<uint8_t>(letter), 1, 2});
    }
  }
  return picture;
}

// The letters of `picture`, whose green and blue samples are 1 and 2, with / between rows.
std::string letters(const RgbImage& picture) {
  std::string text;
  for (size_t at = 0; at < picture.samples.size(); at += 3) {
    if (at != 0 && at / 3 % picture.width == 0) text += '/';
    const bool right = picture.samples[at + 1] == 1 && picture.samples[at + 2] == 2;
    text += right ? static_cast<char>(picture.samples[at]) : '?';
  }
  return text;
}

// Two rows of three views of 2 x 1 pixels: AB CD EF above GH IJ KL.
struct Example {
  Mosaic mosaic;
  RgbImage picture;
  std::vector<std::string> views;  // row by row
};

std::vector<Example> examples() {
  return {
      {{MosaicLayout::kTiles, 2, 3},
       picture_of({"ABCDEF", "GHIJKL"}),
       {"AB", "CD", "EF", "GH", "IJ", "KL"}},
      {{MosaicLayout::kLenslets, 2, 3},
       picture_of({"ACEBDF", "GIKHJL"}),
       {"AB", "CD", "EF", "GH", "IJ", "KL"}},
      {{MosaicLayout::kQuilt, 2, 3},
       picture_of({"GHIJKL", "ABCDEF"}),
       {"AB", "CD", "EF", "GH", "IJ", "KL"}},
      // The rest of a quilt is on top and on the right.
      {{MosaicLayout::kQuilt, 2, 2},
       picture_of({"....x", "EFGH.", "ABCD."}),
       {"AB", "CD", "EF", "GH"}},
      {{MosaicLayout::kTiles, 1, 2}, picture_of({"abcd", "efgh"}), {"ab/ef", "cd/gh"}},
      {{MosaicLayout::kLenslets, 2, 1}, picture_of({"ab", "cd", "ef", "gh"}), {"ab/ef", "cd/gh"}},
  };
}

TEST(ViewMosaic, ViewsOfAPicture) {
  for (const Example& example : examples()) {
    const GridShape grid = example.mosaic.grid();
    ASSERT_EQ(grid.rows * grid.cols, example.views.size());
    for (uint32_t k = 0; k < example.views.size(); ++k) {
      const RgbImage view =
          view_of_mosaic(example.picture, example.mosaic, k / grid.cols, k % grid.cols);
      EXPECT_EQ(letters(view), example.views[k]) << letters(example.picture) << " view " << k;
    }
  }
}

TEST(ViewMosaic, PictureOfViews) {
  for (const Example& example : examples()) {
    const auto shape = mosaic_shape("a.png", example.picture, example.mosaic);
    ASSERT_TRUE(shape);
    auto made = empty_mosaic("a.png", *shape, example.mosaic);
    ASSERT_TRUE(made);
    const GridShape grid = example.mosaic.grid();
    for (uint32_t k = 0; k < example.views.size(); ++k) {
      const uint32_t row = k / grid.cols;
      const uint32_t col = k % grid.cols;
      put_into_mosaic(*made, example.mosaic, row, col,
                      view_of_mosaic(example.picture, example.mosaic, row, col));
    }
    if (letters(example.picture).find('x') != std::string::npos) continue;  // rests are not kept
    EXPECT_EQ(letters(*made), letters(example.picture));
  }
}

TEST(ViewMosaic, ShapeAndDepth) {
  RgbImage picture = picture_of({"ABCDEF", "GHIJKL"});
  picture.depth = 10;
  EXPECT_EQ(mosaic_shape("a.png", picture, {MosaicLayout::kQuilt, 2, 3}),
            (LightFieldShape{1, 6, 2, 1, 10}));
  EXPECT_EQ(mosaic_shape("a.png", picture, {MosaicLayout::kLenslets, 1, 2}),
            (LightFieldShape{1, 2, 3, 2, 10}));
  const auto odd = mosaic_shape("a.png", picture, {MosaicLayout::kTiles, 2, 4});
  ASSERT_FALSE(odd);
  EXPECT_EQ(odd.error().message,
            "a.png: 6 x 2 pixels cannot be divided into 4 columns and 2 rows of views");
}

TEST(ViewMosaic, TooLargeForOnePicture) {
  const auto wide = empty_mosaic("a.png", {1, 2, 40000, 1, 8}, {MosaicLayout::kTiles, 1, 2});
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error().message.find("a.png: 80000 x 1 pixels are too many"), 0);
  EXPECT_FALSE(empty_mosaic("a.png", {4, 4, 16384, 16384, 8}, {MosaicLayout::kTiles, 4, 4}));
}

TEST(ViewMosaic, NamesOfQuilts) {
  const auto quilt = parse_quilt_name("folder_qs1x1a1/cat_qs8x6a0.75.png");
  ASSERT_TRUE(quilt);
  EXPECT_EQ(quilt->mosaic.layout, MosaicLayout::kQuilt);
  EXPECT_EQ(quilt->mosaic.cols, 8u);
  EXPECT_EQ(quilt->mosaic.rows, 6u);
  EXPECT_EQ(quilt->aspect, 0.75);
  EXPECT_TRUE(parse_quilt_name("_qs64x64a1.png"));
  EXPECT_EQ(parse_quilt_name("Cat_QS5x9A1.6 (1).PNG")->aspect, 1.6);
  EXPECT_EQ(parse_quilt_name("cat_qs5x9a1.778_0001.jpg")->mosaic.rows, 9u);
  EXPECT_EQ(parse_quilt_name("cat_qs8x6.png")->aspect, std::nullopt);
  for (const char* name :
       {"cat.png", "cat_qs8x6b.png", "cat_qs8x6a.png", "cat_qs0x6a1.png", "cat_qs8x0a1.png",
        "cat_qs8x6a0.png", "cat_qs8x6a-1.png", "cat_qs8x6anan.png", "cat_qs64x65a1.png",
        "cat_qs8x6a1x.png", "cat_qs4294967297x1a1.png", "cat_qs-8x6a1.png", "cat_qsx6a1.png"}) {
    EXPECT_FALSE(parse_quilt_name(name)) << name;
  }
}

}  // namespace
}  // namespace hmlfc::io
