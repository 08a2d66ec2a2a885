// Truncated, altered and hostile picture files: an error that names the file, never a crash.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "io/image_files.hpp"
#include "io/sample_images.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using test::Bytes;
using test::PngContent;

Bytes random_rows(size_t count) {
  Bytes rows;
  for (const uint16_t sample : test::random_image(1, static_cast<uint32_t>(count), 8, 1).samples) {
    rows.push_back(static_cast<uint8_t>(sample));
  }
  rows.resize(count);
  return rows;
}

/// One small file of each kind. The last byte of each is needed.
std::map<std::string, Bytes> small_files() {
  std::map<std::string, Bytes> files;
  files["rgb8.png"] = test::make_png({.width = 5, .height = 3, .rows = random_rows(45)});
  PngContent wide{.width = 5, .height = 3, .bit_depth = 16, .rows = random_rows(90)};
  wide.significant = Bytes{10, 10, 10};
  files["rgb16.png"] = test::make_png(wide);
  PngContent palette{.width = 5, .height = 3, .colour_type = 3, .rows = Bytes(15, 1)};
  palette.palette = {1, 2, 3, 4, 5, 6};
  palette.palette_alpha = {9};
  files["palette.png"] = test::make_png(palette);
  files["interlaced.png"] = test::make_png(
      {.width = 9, .height = 9, .colour_type = 0, .rows = random_rows(81), .interlaced = true});
  files["baseline.jpg"] =
      test::make_jpeg({.width = 19, .height = 9, .pixels = random_rows(19 * 9 * 3)});
  files["progressive.jpg"] = test::make_jpeg(
      {.width = 19, .height = 9, .pixels = random_rows(19 * 9 * 3), .progressive = true});
  test::TiffContent tiff{.width = 5, .height = 3, .samples = std::vector<uint16_t>(45, 7)};
  files["strips.tif"] = test::make_tiff(tiff);
  tiff.tile = 16;
  tiff.coding = 5;
  files["tiles.tif"] = test::make_tiff(tiff);
  files["lossless.webp"] = test::make_webp(5, 3, random_rows(45));
  files["extended.webp"] = test::make_webp(5, 3, random_rows(45), test::make_exif(1));
  files["binary.ppm"] = test::to_bytes("P6\n# c\n2 2\n255\nABCDEFGHIJKL");
  files["binary.pgm"] = test::to_bytes("P5 2 2 4095 \x01G\x01H\x01I\x01J");
  files["plain.ppm"] = test::to_bytes("P3 2 1 255 10 20 30 40 50 6");
  files["plain.pgm"] = test::to_bytes("P2 2 1 255 # c\n10 6");
  return files;
}

class DamagedImageTest : public testing::Test {
 protected:
  IoResult<RgbImage> read(const std::string& name, std::span<const uint8_t> bytes,
                          const ImageLimits& limits = {}) {
    test::put_file(folder_ / name, bytes);
    return read_image(folder_ / name, limits);
  }

  test::TempFolder folder_;
};

// The two tests below change one file in place: thousands of new files would take minutes.

TEST_F(DamagedImageTest, EveryTruncationIsAnErrorThatNamesTheFile) {
  for (const auto& [name, bytes] : small_files()) {
    test::put_file(folder_ / name, bytes);
    for (size_t length = bytes.size(); length-- > 0;) {
      std::filesystem::resize_file(folder_ / name, length);
      const auto image = read_image(folder_ / name);
      ASSERT_FALSE(image.has_value()) << name << " cut to " << length << " of " << bytes.size();
      ASSERT_NE(image.error().message.find(name), std::string::npos) << image.error().message;
      ASSERT_EQ(image.error().message.find("4294967295"), std::string::npos);  // no scanline's
    }
  }
}

TEST_F(DamagedImageTest, EveryFlippedBitGivesAnErrorOrAPictureOfConsistentSize) {
  for (const auto& [name, bytes] : small_files()) {
    test::put_file(folder_ / name, bytes);
    std::fstream file(folder_ / name, std::ios::binary | std::ios::in | std::ios::out);
    const auto put_byte = [&file](size_t position, unsigned value) {
      file.seekp(static_cast<std::streamoff>(position)).put(static_cast<char>(value)).flush();
    };
    for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
      put_byte(bit / 8, bytes[bit / 8] ^ 1u << bit % 8);
      const auto image = read_image(folder_ / name, ImageLimits{uint64_t{1} << 20});
      put_byte(bit / 8, bytes[bit / 8]);
      if (!image) continue;
      ASSERT_EQ(image->samples.size(), size_t{image->width} * image->height * 3) << name;
    }
    ASSERT_TRUE(file.good());
    ASSERT_EQ(test::get_file(folder_ / name), bytes) << "the test did not restore the file";
  }
}

TEST_F(DamagedImageTest, OtherFilesAreRefused) {
  for (const char* content : {"", "P", "\x89PNG", "GIF89a....", "{}", "\xFF\xD8"}) {
    const auto image = read("a.png", test::to_bytes(content));
    ASSERT_FALSE(image.has_value()) << content;
    EXPECT_NE(image.error().message.find("a.png"), std::string::npos);
  }
}

TEST_F(DamagedImageTest, MissingFilesAndFoldersAreRefused) {
  EXPECT_FALSE(read_image(folder_ / "absent.png").has_value());
  const auto image = read_image(folder_.path());
  ASSERT_FALSE(image.has_value());
  EXPECT_NE(image.error().message.find("not a regular file"), std::string::npos);
}

TEST_F(DamagedImageTest, TheLimitOfSamplesHoldsForEachKind) {
  for (const auto& [name, bytes] : small_files()) {
    const auto whole = read(name, bytes);
    ASSERT_TRUE(whole.has_value());
    const uint64_t samples = whole->samples.size();
    EXPECT_TRUE(read(name, bytes, ImageLimits{samples}).has_value()) << name;
    const auto refused = read(name, bytes, ImageLimits{samples - 1});
    ASSERT_FALSE(refused.has_value()) << name;
    EXPECT_NE(refused.error().message.find("over the limit"), std::string::npos);
  }
}

/// The file with width and height of its PNG header replaced, and the header's check sum with them.
Bytes with_png_size(Bytes bytes, uint32_t width, uint32_t height) {
  for (size_t i = 0; i < 4; ++i) {
    bytes[16 + i] = static_cast<uint8_t>(width >> (24 - 8 * i));
    bytes[20 + i] = static_cast<uint8_t>(height >> (24 - 8 * i));
  }
  uint32_t crc = ~0u;  // CRC-32 of the chunk's name and content, bit by bit
  for (size_t i = 12; i < 29; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xEDB88320u & (~(crc & 1) + 1));
  }
  for (size_t i = 0; i < 4; ++i) bytes[29 + i] = static_cast<uint8_t>(~crc >> (24 - 8 * i));
  return bytes;
}

TEST_F(DamagedImageTest, AShortFileThatClaimsAHugePictureIsRefusedBeforeAllocation) {
  const ImageLimits none{~uint64_t{0}};
  const Bytes png = small_files()["rgb8.png"];
  ASSERT_TRUE(read("a.png", with_png_size(png, 5, 3)).has_value()) << "the header was built wrong";
  const auto huge_png = read("a.png", with_png_size(png, 60000, 60000), none);
  ASSERT_FALSE(huge_png.has_value());
  EXPECT_NE(huge_png.error().message.find("too short"), std::string::npos);
  EXPECT_FALSE(read("a.png", with_png_size(png, 65537, 1), none).has_value());

  Bytes jpeg = small_files()["baseline.jpg"];
  for (size_t i = 0; i + 9 < jpeg.size(); ++i) {
    if (jpeg[i] == 0xFF && jpeg[i + 1] == 0xC0) {
      for (size_t k = 5; k < 9; ++k) jpeg[i + k] = 0xF0;  // height and width 61680
    }
  }
  const auto huge_jpeg = read("a.jpg", jpeg, none);
  ASSERT_FALSE(huge_jpeg.has_value());
  EXPECT_NE(huge_jpeg.error().message.find("too short"), std::string::npos);
}

}  // namespace
}  // namespace hmlfc::io
