// PPM and PGM in all flavours.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "io/image_files.hpp"
#include "io/sample_images.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using Samples = std::vector<uint16_t>;

class PnmTest : public testing::Test {
 protected:
  IoResult<RgbImage> read(const std::string& content) {
    test::put_file(folder_ / "a.ppm", content);
    return read_image(folder_ / "a.ppm");
  }
  Samples samples(const std::string& content) {
    const auto image = read(content);
    EXPECT_TRUE(image.has_value()) << content << ": " << image.error().message;
    return image ? image->samples : Samples{};
  }
  void expect_refused(const std::string& content, const std::string& reason) {
    const auto image = read(content);
    ASSERT_FALSE(image.has_value()) << content;
    EXPECT_NE(image.error().message.find("a.ppm"), std::string::npos) << image.error().message;
    EXPECT_NE(image.error().message.find(reason), std::string::npos) << image.error().message;
  }

  test::TempFolder folder_;
};

TEST_F(PnmTest, ReadsEachKindAndSkipsComments) {
  EXPECT_EQ(samples(std::string("P6\n2 1\n255\n\x01\x02\x03\xFD\xFE\xFF", 17)),
            (Samples{1, 2, 3, 253, 254, 255}));
  EXPECT_EQ(samples("P5 1 2 255 AB"), (Samples{65, 65, 65, 66, 66, 66}));
  EXPECT_EQ(samples("P3 2 1 255  1 2 3\n253\t254 255"), (Samples{1, 2, 3, 253, 254, 255}));
  EXPECT_EQ(samples("P2\n1 2\n255\n7\n9\n"), (Samples{7, 7, 7, 9, 9, 9}));
  EXPECT_EQ(samples("P5# made by hand\n# 9 9 255\n 1#x\n1\n#\n255\nA"), (Samples{65, 65, 65}));
  EXPECT_EQ(samples("P2 1 2 255 7 # seven\n 9"), (Samples{7, 7, 7, 9, 9, 9}));
  EXPECT_EQ(samples("P5\r\n2 1\r\n255\r\nAB"), (Samples{65, 65, 65, 66, 66, 66}));
  // The first byte of a raster may look like space.
  EXPECT_EQ(samples("P5 2 1 255\n\n "), (Samples{10, 10, 10, 32, 32, 32}));
}

TEST_F(PnmTest, KeepsEveryDepth) {
  const std::string two_bytes("\x01\xFE\x00\x07\x00\x00", 6);
  for (int bits = 9; bits <= 12; ++bits) {
    const auto image = read("P6 1 1 " + std::to_string((1 << bits) - 1) + "\n" + two_bytes);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->depth, bits);
    EXPECT_EQ(image->samples, (Samples{0x1FE, 7, 0}));
  }
}

TEST_F(PnmTest, CutsMoreThan12BitsTo12) {
  const auto wide = read("P3 1 1 65535 65535 4096 15");
  ASSERT_TRUE(wide) << wide.error().message;
  EXPECT_EQ(wide->depth, 12);
  EXPECT_EQ(wide->samples, (Samples{4095, 256, 0}));
  EXPECT_EQ(samples("P2 1 1 8191 8191"), (Samples{4095, 4095, 4095}));
}

TEST_F(PnmTest, ScalesOtherGreatestValues) {
  for (const int most : {1, 15, 100, 254, 256, 1000, 4096, 65534}) {
    const int depth = std::clamp(static_cast<int>(std::bit_width(unsigned(most))), 8, 12);
    std::string content = "P2 1001 1 " + std::to_string(most);
    Samples expected;
    for (int i = 0; i <= 1000; ++i) {
      const int value = most * i / 1000;
      content += " " + std::to_string(value);
      const double scaled = static_cast<double>(value) * ((1 << depth) - 1) / most;
      expected.insert(expected.end(), 3, static_cast<uint16_t>(std::lround(scaled)));
    }
    const auto image = read(content);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->depth, depth);
    EXPECT_EQ(image->samples, expected) << most;
  }
}

TEST_F(PnmTest, SaysWhatItChangedOrIgnored) {
  test::put_file(folder_ / "a.ppm", std::string("P5 1 1 1000 \x03\xE8\nP5 1 1 255 A"));
  Notes notes;
  const auto image = read_image(folder_ / "a.ppm", {}, &notes);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->samples, Samples(3, 1023));
  const std::string file = (folder_ / "a.ppm").string();
  EXPECT_EQ(notes.lines(),
            (std::vector{file + ": samples of 0 to 1000 are scaled to 0 to 1023",
                         file + ": what follows the end of the picture is ignored"}));
}

TEST_F(PnmTest, SaysWhatIsWrong) {
  for (const char* most : {"0", "65536", "99999999999"}) {
    expect_refused(std::string("P5 1 1 ") + most + "\nAA", "a number in [1, 65535]");
  }
  expect_refused("P2 1 1 1000 1001", "over the greatest value 1000; the file is damaged");
  expect_refused("P2 1 1 255 256", "over the greatest value 255");
  expect_refused(std::string("P5 1 1 1023\n\x04\x00", 14), "over the greatest value 1023");
  for (const char* size : {"0 1", "1 0", "65537 1", "1 65537", "-1 1", "x 1", "1", ""}) {
    expect_refused(std::string("P5 ") + size, "width and height");
  }
  for (const char* kind : {"P1", "P4", "P7", "Pf", "PF"}) {
    expect_refused(std::string(kind) + "\n1 1 255\n1", "not supported: convert it");
  }
}

TEST_F(PnmTest, ChecksTheLengthBeforeItAllocates) {
  const auto huge = ImageLimits{~uint64_t{0}};
  for (const char* kind : {"P2", "P3", "P5", "P6"}) {
    test::put_file(folder_ / "a.ppm", std::string(kind) + " 65536 65536 4095\n1 2 3");
    const auto image = read_image(folder_ / "a.ppm", huge);
    ASSERT_FALSE(image.has_value());
    EXPECT_NE(image.error().message.find("ends before"), std::string::npos);
  }
}

TEST_F(PnmTest, WritesAndReadsEveryDepthExactly) {
  for (int depth = 8; depth <= 12; ++depth) {
    const RgbImage image = test::random_image(31, 7, depth, 5);
    ASSERT_TRUE(write_ppm(folder_ / "a.ppm", image));
    const auto again = read_image(folder_ / "a.ppm");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->depth, depth);
    EXPECT_EQ(again->samples, image.samples);
  }
}

TEST_F(PnmTest, WritesTheFormThatOtherProgramsRead) {
  ASSERT_TRUE(write_ppm(folder_ / "a.ppm", {1, 1, 8, {65, 66, 67}}));
  EXPECT_EQ(test::get_file(folder_ / "a.ppm"), test::to_bytes("P6\n1 1\n255\nABC"));
  ASSERT_TRUE(write_ppm(folder_ / "a.ppm", {1, 1, 10, {0x341, 0x042, 0x143}}));
  EXPECT_EQ(test::get_file(folder_ / "a.ppm"),
            test::to_bytes(std::string("P6\n1 1\n1023\n\x03\x41\x00\x42\x01\x43", 18)));
}

}  // namespace
}  // namespace hmlfc::io
