// TIFF files of each layout, and those that are refused.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "io/image_files.hpp"
#include "io/sample_images.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using test::Bytes;
using test::TiffContent;
using Samples = std::vector<uint16_t>;

class TiffTest : public testing::Test {
 protected:
  IoResult<RgbImage> read(const TiffContent& content) {
    test::put_file(folder_ / "a.tif", test::make_tiff(content));
    notes_ = {};
    return read_image(folder_ / "a.tif", {}, &notes_);
  }
  std::string refusal(const TiffContent& content) {
    const auto image = read(content);
    EXPECT_FALSE(image.has_value());
    return image ? "" : image.error().message;
  }
  std::string line(const std::string& what) { return (folder_ / "a.tif").string() + ": " + what; }

  test::TempFolder folder_;
  Notes notes_;
};

TiffContent random_content(uint32_t width, uint32_t height, uint16_t bits, uint16_t channels) {
  TiffContent content{.width = width, .height = height, .bits = bits, .channels = channels};
  content.colours = channels < 3 ? 1 : 2;
  std::mt19937 random(bits + channels);
  content.samples.resize(size_t{width} * height * channels);
  for (uint16_t& sample : content.samples) sample = static_cast<uint16_t>(random() >> (32 - bits));
  return content;
}

/// The samples as they are to be read: 8 bits as they are, of 16 the upper 12.
Samples expected_of(const TiffContent& content) {
  Samples expected;
  for (size_t i = 0; i < content.samples.size(); i += content.channels) {
    for (size_t channel = 0; channel < 3; ++channel) {
      const uint16_t sample = content.samples[i + (content.colours == 2 ? channel : 0)];
      const int inverted = content.colours != 0 ? sample : (1 << content.bits) - 1 - sample;
      expected.push_back(static_cast<uint16_t>(content.bits == 16 ? inverted / 16 : inverted));
    }
  }
  return expected;
}

TEST_F(TiffTest, ReadsEachLayout) {
  for (const uint16_t channels : std::to_array<uint16_t>({1, 2, 3, 4})) {
    for (const uint16_t bits : std::to_array<uint16_t>({8, 16})) {
      for (const uint16_t coding : std::to_array<uint16_t>({1, 5, 8, 32773})) {
        for (const uint16_t planes : std::to_array<uint16_t>({1, 2})) {
          for (const uint32_t tile : {0u, 16u}) {
            TiffContent content = random_content(37, 21, bits, channels);
            content.coding = coding;
            content.planes = planes;
            content.tile = tile;
            if (tile > 0 || channels == 4) content.order = "wb";
            if (channels == 1 && tile > 0) content.colours = 0;
            const auto image = read(content);
            ASSERT_TRUE(image) << image.error().message;
            EXPECT_EQ(image->width, 37u);
            EXPECT_EQ(image->depth, bits == 16 ? 12 : 8);
            ASSERT_EQ(image->samples, expected_of(content))
                << channels << ' ' << bits << ' ' << coding << ' ' << planes << ' ' << tile;
          }
        }
      }
    }
  }
  EXPECT_EQ(notes_.lines(),
            (std::vector{line("samples of 16 bits are reduced to 12 bits, the most that a stream "
                              "holds"),
                         line("the alpha channel is dropped")}));
}

TEST_F(TiffTest, SaysThatOtherPicturesAreLeftOut) {
  TiffContent content = random_content(3, 3, 8, 3);
  content.pictures = 2;
  content.orientation = 3;
  const auto image = read(content);
  ASSERT_TRUE(image) << image.error().message;
  const Samples upright = expected_of(content);
  EXPECT_EQ(image->samples[0], upright[24]);
  EXPECT_EQ(notes_.lines(), (std::vector{line("only the first picture of the file is read"),
                                         line("its EXIF orientation 3 is applied")}));
}

TEST_F(TiffTest, RefusesByNameWhatItDoesNotRead) {
  TiffContent content = random_content(3, 3, 16, 3);
  content.format = 3;
  EXPECT_NE(refusal(content).find("SampleFormat 3"), std::string::npos);
  content = random_content(3, 3, 8, 4);
  content.colours = 5;
  EXPECT_NE(refusal(content).find("PhotometricInterpretation 5"), std::string::npos);
  content.colours = 2;
  content.subfile = 1;
  EXPECT_NE(refusal(content).find("preview; not supported"), std::string::npos);
}

}  // namespace
}  // namespace hmlfc::io
