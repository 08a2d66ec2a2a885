// Every kind of PNG that is read, and the PNG that is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <string_view>
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

TEST_F(PngTest, SaysThat12BitsInTheLowerOnesOf16AreTooDark) {
  test::put_file(folder_ / "a.png", make_png({.bit_depth = 16, .rows = {15, 255, 0, 0, 0, 0}}));
  Notes notes;
  ASSERT_TRUE(read_image(folder_ / "a.png", {}, &notes).has_value());
  EXPECT_TRUE(notes.lines().at(0).ends_with("multiply them by 16 first"));
}

TEST_F(PngTest, TakesTheDepthOfGreyFromItsOwnSignificantBits) {
  PngContent content{.bit_depth = 16, .colour_type = 0, .rows = {0xAB, 0xCD}};
  content.significant = Bytes{10};
  EXPECT_EQ(read(content).samples, Samples(3, 0x2AF));
}

/// Random values of a PNG, and what they are to be read as.
struct RandomPng {
  PngContent content;
  Samples expected;
};

RandomPng random_png(int colour_type, int bits, bool interlaced) {
  RandomPng png{.content = {.width = 13, .height = 11, .bit_depth = bits}, .expected = {}};
  png.content.colour_type = colour_type;
  png.content.interlaced = interlaced;
  std::mt19937 random(static_cast<unsigned>(colour_type * 100 + bits));
  if (colour_type == 3) {
    for (int i = 0; i < 3 << bits; ++i) png.content.palette.push_back(uint8_t(random() >> 24));
  }
  const std::array<int, 7> kChannels = {1, 0, 3, 1, 2, 0, 4};
  const int channels = kChannels.at(static_cast<size_t>(colour_type));
  for (uint32_t y = 0; y < png.content.height; ++y) {
    uint32_t buffer = 0;
    int filled = 0;
    for (uint32_t x = 0; x < png.content.width; ++x) {
      std::array<uint32_t, 4> values{};
      for (int channel = 0; channel < channels; ++channel) {
        const auto value = static_cast<uint32_t>(random() >> (32 - bits));
        values.at(static_cast<size_t>(channel)) = value;
        buffer = buffer << bits | value;
        for (filled += bits; filled >= 8; filled -= 8) {
          png.content.rows.push_back(static_cast<uint8_t>(buffer >> (filled - 8)));
        }
      }
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t value = channels < 3 ? values[0] : values.at(i);
        const uint32_t eight = value * 255 / ((1u << bits) - 1);
        png.expected.push_back(colour_type == 3 ? png.content.palette[3 * value + i]
                               : bits == 16     ? static_cast<uint16_t>(value / 16)
                                                : static_cast<uint16_t>(eight));
      }
    }
    if (filled > 0) png.content.rows.push_back(static_cast<uint8_t>(buffer << (8 - filled)));
  }
  return png;
}

TEST_F(PngTest, ReadsEveryColourTypeDepthAndOrderOfRows) {
  for (const int colour_type : {0, 2, 3, 4, 6}) {
    for (const int bits : {1, 2, 4, 8, 16}) {
      if (bits < 8 && colour_type != 0 && colour_type != 3) continue;
      if (bits == 16 && colour_type == 3) continue;
      for (const bool interlaced : {false, true}) {
        const RandomPng png = random_png(colour_type, bits, interlaced);
        EXPECT_EQ(read(png.content).samples, png.expected) << colour_type << ' ' << bits;
      }
    }
  }
}

TEST_F(PngTest, AppliesEveryOrientation) {
  const std::vector<std::pair<uint32_t, Samples>> expected = {
      {3, {1, 2, 3, 4, 5, 6}}, {3, {3, 2, 1, 6, 5, 4}}, {3, {6, 5, 4, 3, 2, 1}},
      {3, {4, 5, 6, 1, 2, 3}}, {2, {1, 4, 2, 5, 3, 6}}, {2, {4, 1, 5, 2, 6, 3}},
      {2, {6, 3, 5, 2, 4, 1}}, {2, {3, 6, 2, 5, 1, 4}}, {3, {1, 2, 3, 4, 5, 6}}};
  for (const char* order : {"II", "MM"}) {
    for (size_t i = 0; i < expected.size(); ++i) {
      PngContent content{.width = 3, .height = 2, .colour_type = 0, .rows = {1, 2, 3, 4, 5, 6}};
      content.chunks = {{"eXIf", test::make_exif(static_cast<uint8_t>(i + 1), order)}};
      const RgbImage image = read(content);
      EXPECT_EQ(image.width, expected[i].first);
      Samples grey;
      for (size_t k = 0; k < image.samples.size(); k += 3) grey.push_back(image.samples[k]);
      EXPECT_EQ(grey, expected[i].second) << "orientation " << i + 1;
    }
  }
}

TEST_F(PngTest, SaysOnceWhatItIgnores) {
  const std::string profile("\x78\x01\x01\x04\x00\xfb\xffsRGB", 11);  // deflated as it is
  const std::vector<std::pair<std::pair<std::string, Bytes>, std::string>> cases = {
      {{"sBIT", {0, 0, 0}}, "carries no samples"},
      {{"sBIT", {8}}, "carries no samples"},
      {{"tRNS", Bytes(7)}, "transparency (tRNS) is dropped"},
      {{"acTL", {0, 0, 0, 2, 0, 0, 0, 0}}, "only the first picture"},
      {{"eXIf", test::make_exif(2)}, "orientation 2 is applied"},
      {{"eXIf", Bytes(3)}, ""},
      {{"tEXt", Bytes(3)}, ""},
      {{"iCCP", test::to_bytes(std::string("n\0\0", 3) + profile)}, ""},
      {{"iCCP", test::to_bytes("damaged")}, ""},
      {{"iCCP", test::to_bytes(std::string("n\0\0\x78\x01\x01\x04\x00\xfb\xffrRGB", 14))},
       "colour profile"},
  };
  for (const auto& [chunk, note] : cases) {
    PngContent content{.rows = {1, 2, 3}};
    content.chunks = {chunk, chunk};
    test::put_file(folder_ / "a.png", make_png(content));
    Notes notes;
    const auto image = read_image(folder_ / "a.png", {}, &notes);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->samples, (Samples{1, 2, 3})) << chunk.first;
    ASSERT_EQ(notes.lines().size(), note.empty() ? 0u : 1u) << chunk.first;
    for (const std::string& line : notes.lines())
      EXPECT_NE(line.find(note), std::string::npos) << line;
  }
}

TEST_F(PngTest, IgnoresWhatFollowsAndAWrongCheckSumOfAnAncillaryChunk) {
  PngContent content{.rows = {1, 2, 3}};
  content.chunks = {{"gAMA", Bytes(4)}};
  Bytes bytes = make_png(content);
  const auto gamma = std::ranges::search(bytes, std::string_view("gAMA")).begin();
  gamma[8] ^= 1;
  bytes.push_back(0);
  test::put_file(folder_ / "a.png", bytes);
  Notes notes;
  EXPECT_TRUE(read_image(folder_ / "a.png", {}, &notes).has_value());
  ASSERT_EQ(notes.lines().size(), 2u);
  EXPECT_NE(notes.lines()[0].find("gAMA: CRC error"), std::string::npos) << notes.lines()[0];
  EXPECT_NE(notes.lines()[1].find("what follows the end"), std::string::npos);
}

TEST_F(PngTest, MakesPixelsBlackThatThePaletteLacks) {
  PngContent content{.width = 2, .colour_type = 3, .rows = {1, 2}};
  content.palette = {1, 2, 3, 4, 5, 6};
  test::put_file(folder_ / "a.png", make_png(content));
  Notes notes;
  const auto image = read_image(folder_ / "a.png", {}, &notes);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->samples, (Samples{4, 5, 6, 0, 0, 0}));
  EXPECT_EQ(notes.lines(), (std::vector{(folder_ / "a.png").string() +
                                        ": pixels without a colour in the palette are black"}));
}

TEST_F(PngTest, TellsUnsupportedFromDamaged) {
  const auto refusal = [&](const Bytes& bytes) {
    test::put_file(folder_ / "a.png", bytes);
    const auto image = read_image(folder_ / "a.png");
    EXPECT_FALSE(image.has_value());
    return image ? "" : image.error().message;
  };
  PngContent content{.rows = {1, 2, 3}};
  content.chunks = {{"FOOB", Bytes(1)}};
  EXPECT_NE(refusal(make_png(content)).find("critical chunk; not supported"), std::string::npos);
  Bytes apple = make_png({.rows = {1, 2, 3}});
  const Bytes cgbi = {0, 0, 0, 4, 'C', 'g', 'B', 'I', 0x30, 0, 0x20, 2, 0, 0, 0, 0};
  apple.insert(apple.begin() + 8, cgbi.begin(), cgbi.end());
  EXPECT_NE(refusal(apple).find("CgBI); not supported"), std::string::npos);
}

}  // namespace
}  // namespace hmlfc::io
