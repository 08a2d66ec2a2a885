// JPEG 2000 codestreams: lossless for every precision and size in use (KEY-2). What is refused are
// vectors.
#include "decoder/jpeg2000.hpp"

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace hmlfc {
namespace {

using Bytes = std::vector<uint8_t>;

// Noise with both ends of the range, which no prediction makes small.
SamplePlane draw_plane(std::mt19937& random, uint32_t width, uint32_t height,
                       SamplePrecision precision) {
  const int32_t count = 1 << precision.bits;
  const int32_t least = precision.is_signed ? -count / 2 : 0;
  SamplePlane plane(width, height);
  for (int16_t& sample : plane.samples) {
    const bool end = random() % 8 == 0;
    const int32_t value = end ? (random() % 2 != 0 ? 0 : count - 1)
                              : static_cast<int32_t>(random() % static_cast<uint32_t>(count));
    sample = static_cast<int16_t>(least + value);
  }
  return plane;
}

// Decodes as KEY-2 and KEY-4 say.
std::optional<SamplePlane> decode(std::span<const uint8_t> codestream, uint32_t width,
                                  uint32_t height, SamplePrecision precision) {
  if (!has_key_image_head(codestream, width, height, precision)) return std::nullopt;
  return decode_jpeg2000(codestream, width, height);
}

void check_round_trip(const SamplePlane& plane, SamplePrecision precision) {
  const auto codestream = encode_jpeg2000(plane, precision);
  ASSERT_TRUE(codestream.has_value());
  const auto decoded = decode(*codestream, plane.width, plane.height, precision);
  ASSERT_TRUE(decoded.has_value()) << plane.width << "x" << plane.height;
  ASSERT_EQ(decoded->width, plane.width);
  ASSERT_EQ(decoded->height, plane.height);
  ASSERT_EQ(decoded->samples, plane.samples) << plane.width << "x" << plane.height;
}

TEST(Jpeg2000, LosslessForEveryPrecision) {
  std::mt19937 random(1);
  for (int bits = 8; bits <= 13; ++bits) {
    for (const bool is_signed : {false, true}) {
      const SamplePrecision precision{bits, is_signed};
      for (const uint32_t height : {1u, 2u, 3u, 17u}) {
        for (const uint32_t width : {1u, 2u, 5u, 16u, 33u}) {
          ASSERT_NO_FATAL_FAILURE(
              check_round_trip(draw_plane(random, width, height, precision), precision))
              << bits << (is_signed ? " bits signed" : " bits");
        }
      }
    }
  }
}

TEST(Jpeg2000, LosslessForEverySize) {
  std::mt19937 random(2);
  for (uint32_t height = 1; height <= 17; ++height) {
    for (uint32_t width = 1; width <= 33; ++width) {
      const SamplePrecision precision{9, true};
      ASSERT_NO_FATAL_FAILURE(
          check_round_trip(draw_plane(random, width, height, precision), precision));
    }
  }
  const SamplePrecision deep{12, false};
  ASSERT_NO_FATAL_FAILURE(check_round_trip(draw_plane(random, 1, 1500, deep), deep));
  ASSERT_NO_FATAL_FAILURE(check_round_trip(draw_plane(random, 700, 130, deep), deep));
}

TEST(Jpeg2000, LosslessWithEveryStyleAndLayers) {
  std::mt19937 random(7);
  const SamplePrecision precision{8, false};
  const SamplePlane plane = draw_plane(random, 23, 19, precision);
  for (unsigned style = 0; style < 64; ++style) {
    CodestreamOptions options;
    options.style = style;
    options.layers = 1 + style % 3;
    options.progression = style % 5;
    options.sop = style % 7 > 3;
    options.eph = style % 3 == 0;
    options.block_width = 8;
    options.block_height = 16;
    options.precinct_log2 = style % 2 * 15;
    const Bytes codestream = encode_jpeg2000(plane, precision, options).value();
    const auto decoded = decode(codestream, plane.width, plane.height, precision);
    ASSERT_TRUE(decoded.has_value()) << style;
    EXPECT_EQ(decoded->samples, plane.samples) << style;
  }
}

}  // namespace
}  // namespace hmlfc
