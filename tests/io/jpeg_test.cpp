#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "io/image_files.hpp"
#include "io/sample_images.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using test::JpegContent;

/// Red rises to the right, green downwards, blue falls to the right.
JpegContent ramp(uint32_t width, uint32_t height) {
  JpegContent content{.width = width, .height = height};
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      content.pixels.push_back(static_cast<uint8_t>(20 + 3 * x));
      content.pixels.push_back(static_cast<uint8_t>(10 + 4 * y));
      content.pixels.push_back(static_cast<uint8_t>(250 - 2 * x));
    }
  }
  return content;
}

class JpegTest : public testing::Test {
 protected:
  IoResult<RgbImage> read(const JpegContent& content) {
    test::put_file(folder_ / "a.jpg", test::make_jpeg(content));
    return read_image(folder_ / "a.jpg");
  }
  void expect_close(const IoResult<RgbImage>& image, const JpegContent& content, int tolerance) {
    ASSERT_TRUE(image.has_value()) << image.error().message;
    ASSERT_EQ(image->width, content.width);
    ASSERT_EQ(image->height, content.height);
    ASSERT_EQ(image->depth, 8);
    ASSERT_EQ(image->samples.size(), content.pixels.size());
    for (size_t i = 0; i < content.pixels.size(); ++i) {
      ASSERT_LE(std::abs(image->samples[i] - content.pixels[i]), tolerance) << "sample " << i;
    }
  }

  test::TempFolder folder_;
};

TEST_F(JpegTest, ReadsColourCloseToTheSource) {
  JpegContent content = ramp(50, 37);
  expect_close(read(content), content, 4);
  content.progressive = true;
  expect_close(read(content), content, 4);
  content.full_chroma = false;
  expect_close(read(content), content, 12);
}

TEST_F(JpegTest, ReplicatesGrey) {
  JpegContent content{.width = 16, .height = 9, .channels = 1};
  for (int i = 0; i < 16 * 9; ++i) content.pixels.push_back(static_cast<uint8_t>(i));
  const auto image = read(content);
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_EQ(image->samples.size(), size_t{16 * 9 * 3});
  for (size_t i = 0; i < content.pixels.size(); ++i) {
    ASSERT_LE(std::abs(image->samples[3 * i] - content.pixels[i]), 2);
    ASSERT_EQ(image->samples[3 * i], image->samples[3 * i + 1]);
    ASSERT_EQ(image->samples[3 * i], image->samples[3 * i + 2]);
  }
}

TEST_F(JpegTest, RefusesCmyk) {
  JpegContent content{.width = 8, .height = 8, .channels = 4};
  content.pixels.assign(8 * 8 * 4, 100);
  const auto image = read(content);
  ASSERT_FALSE(image.has_value());
  EXPECT_NE(image.error().message.find("convert it to RGB"), std::string::npos);
}

}  // namespace
}  // namespace hmlfc::io
