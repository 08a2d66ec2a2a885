#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/image_files.hpp"
#include "io/sample_images.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using test::Bytes;
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
  for (const auto& [h, v] : {std::pair{2, 2}, {2, 1}, {1, 2}, {4, 1}}) {
    content.h = h;
    content.v = v;
    content.restart = 3 - content.restart;
    content.progressive = !content.progressive;
    expect_close(read(content), content, 12);
  }
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

/// The position of marker 0xFF `code` in `file`.
size_t marker(const Bytes& file, uint8_t code) {
  const std::array<uint8_t, 2> marker = {0xFF, code};
  return static_cast<size_t>(std::ranges::search(file, marker).begin() - file.begin());
}

TEST_F(JpegTest, SaysOnceWhatItIgnores) {
  JpegContent content = ramp(16, 16);
  content.adobe = true;
  content.exif = test::to_bytes(std::string("Exif\0\0", 6));
  for (const uint8_t byte : test::make_exif(1, "MM")) content.exif.push_back(byte);
  const Bytes good = test::make_jpeg(content);
  const RgbImage expected = *read(content);
  std::map<std::string, Bytes> cases;
  cases[""] = good;
  Bytes& transform = cases["Unknown Adobe color transform code 9"] = good;
  transform[marker(good, 0xEE) + 15] = 9;
  Bytes& progression = cases["Invalid SOS parameters"] = good;
  progression[marker(good, 0xDA) + 12] = 0;
  Bytes& stray = cases["stray bytes before a marker"] = good;
  stray.insert(stray.begin() + static_cast<ptrdiff_t>(marker(good, 0xDA)), 9, 1);
  Bytes& phone = cases["what follows the end of the picture"] = good;
  phone.insert(phone.end(), good.begin(), good.end());
  for (const auto& [note, bytes] : cases) {
    test::put_file(folder_ / "a.jpg", bytes);
    Notes notes;
    const auto image = read_image(folder_ / "a.jpg", {}, &notes);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->samples, expected.samples) << note;
    ASSERT_EQ(notes.lines().size(), note.empty() ? 0u : 1u);
    for (const std::string& line : notes.lines())
      EXPECT_NE(line.find(note), std::string::npos) << line;
  }
}

TEST_F(JpegTest, TellsUnsupportedFromDamaged) {
  JpegContent content = ramp(64, 16);
  content.restart = 2;
  const Bytes good = test::make_jpeg(content);
  std::vector<std::pair<std::string, Bytes>> cases(5, {"", good});
  cases[0].first = "samples of 12 bits; not supported: convert it to a PNG of 16 bits";
  cases[0].second[marker(good, 0xC0) + 4] = 12;
  cases[1].first = "SOF type 0xc3; not supported";
  cases[1].second[marker(good, 0xC0) + 1] = 0xC3;
  cases[2].first = "the file is damaged";  // a restart marker is missing
  cases[2].second[marker(good, 0xD1) + 1] = 0xD5;
  cases[3].first = "the file is damaged";  // stray bytes among the samples
  cases[3].second.insert(cases[3].second.begin() + static_cast<ptrdiff_t>(marker(good, 0xD1)), 9,
                         1);
  cases[4].first = "CMYK, or other colours that are not grey, RGB or YCbCr; not supported";
  cases[4].second = test::make_jpeg({.width = 8, .height = 8, .channels = 4, .pixels = Bytes(256)});
  for (const auto& [reason, bytes] : cases) {
    test::put_file(folder_ / "a.jpg", bytes);
    const auto image = read_image(folder_ / "a.jpg");
    ASSERT_FALSE(image.has_value()) << reason;
    EXPECT_NE(image.error().message.find(reason), std::string::npos) << image.error().message;
  }
}

}  // namespace
}  // namespace hmlfc::io
