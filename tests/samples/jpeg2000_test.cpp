// JPEG 2000 codestreams: lossless for every precision and size in use, refused when damaged
// (KEY-2).
#include "samples/jpeg2000.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "samples/codestream_head.hpp"

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

void check_round_trip(const SamplePlane& plane, SamplePrecision precision) {
  const auto codestream = encode_jpeg2000(plane, precision);
  ASSERT_TRUE(codestream.has_value());
  const auto decoded = decode_jpeg2000(*codestream, plane.width, plane.height, precision);
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

TEST(Jpeg2000, AnotherShapeIsRefused) {
  std::mt19937 random(3);
  const SamplePrecision precision{9, true};
  const Bytes codestream = encode_jpeg2000(draw_plane(random, 12, 7, precision), precision).value();
  EXPECT_TRUE(decode_jpeg2000(codestream, 12, 7, precision));
  EXPECT_FALSE(decode_jpeg2000(codestream, 7, 12, precision));
  EXPECT_FALSE(decode_jpeg2000(codestream, 13, 7, precision));
  EXPECT_FALSE(decode_jpeg2000(codestream, 12, 6, precision));
  EXPECT_FALSE(decode_jpeg2000(codestream, 12, 7, {9, false}));
  EXPECT_FALSE(decode_jpeg2000(codestream, 12, 7, {8, true}));
  EXPECT_FALSE(decode_jpeg2000(codestream, 12, 7, {10, true}));
}

// SIZ decides what OpenJPEG allocates, so it is read before: many tiles or components never get in.
TEST(Jpeg2000, DeclaredShapeIsOneTileOfOneComponent) {
  std::mt19937 random(7);
  const SamplePrecision precision{8, false};
  const Bytes codestream = encode_jpeg2000(draw_plane(random, 12, 7, precision), precision).value();
  ASSERT_TRUE(has_key_image_head(codestream, 12, 7));
  struct Field {
    const char* name;
    size_t at;
    unsigned bytes;
    std::vector<uint32_t> wrong;
  };
  for (const Field& field :
       {Field{"SOC", 0, 2, {0, 0xFF51}}, Field{"SIZ", 2, 2, {0, 0xFF52}},
        Field{"Xsiz", 8, 4, {0, 11, 13, 0x8000000C}}, Field{"Ysiz", 12, 4, {0, 6, 8, 0x80000007}},
        Field{"XOsiz", 16, 4, {1, 0x80000000}}, Field{"YOsiz", 20, 4, {1, 0x80000000}},
        Field{"XTsiz", 24, 4, {0, 1, 11}}, Field{"YTsiz", 28, 4, {0, 1, 6}},
        Field{"XTOsiz", 32, 4, {1, 0x80000000}}, Field{"YTOsiz", 36, 4, {1, 0x80000000}},
        Field{"Csiz", 40, 2, {0, 2, 3, 16384, 65535}}}) {
    for (const uint32_t value : field.wrong) {
      Bytes damaged = codestream;
      for (unsigned i = 0; i < field.bytes; ++i) {
        damaged[field.at + i] = static_cast<uint8_t>(value >> (8 * (field.bytes - 1 - i)));
      }
      EXPECT_FALSE(has_key_image_head(damaged, 12, 7)) << field.name << " = " << value;
      EXPECT_FALSE(decode_jpeg2000(damaged, 12, 7, precision)) << field.name << " = " << value;
    }
  }
  for (size_t length = 0; length < 45; ++length) {
    EXPECT_FALSE(has_key_image_head(std::span(codestream).first(length), 12, 7)) << length;
  }
}

// Big-endian fields one after another, as a codestream has them.
void put_be(Bytes& bytes, unsigned count, uint32_t value) {
  while (count-- > 0) bytes.push_back(static_cast<uint8_t>(value >> (8 * count)));
}

/// 82 bytes: one tile of side x side samples in one resolution, precincts of 2^ppx x 2^ppy, no
/// data.
Bytes codestream_without_data(uint32_t side, unsigned ppx, unsigned ppy) {
  Bytes bytes;
  put_be(bytes, 2, 0xFF4F);  // SOC
  put_be(bytes, 2, 0xFF51);  // SIZ: one component of 8 bits
  put_be(bytes, 2, 41);
  put_be(bytes, 2, 0);
  for (const uint32_t field : {side, side, 0u, 0u, side, side, 0u, 0u}) put_be(bytes, 4, field);
  put_be(bytes, 2, 1);
  put_be(bytes, 3, 0x070101);
  put_be(bytes, 2, 0xFF52);  // COD: precincts given, one layer, 64 x 64 code-blocks, 5/3
  put_be(bytes, 2, 13);
  put_be(bytes, 1, 1);
  put_be(bytes, 4, 0x00000100);
  put_be(bytes, 1, 0);
  put_be(bytes, 4, 0x04040001);
  put_be(bytes, 1, ppx + 16 * ppy);
  put_be(bytes, 2, 0xFF5C);  // QCD: no quantisation
  put_be(bytes, 2, 4);
  put_be(bytes, 2, 0x4040);
  put_be(bytes, 2, 0xFF90);  // SOT
  put_be(bytes, 2, 10);
  put_be(bytes, 2, 0);
  put_be(bytes, 4, 0);
  put_be(bytes, 2, 0x0001);
  put_be(bytes, 2, 0xFF93);  // SOD
  put_be(bytes, 2, 0xFFD9);  // EOC
  return bytes;
}

long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// COD decides how many precincts OpenJPEG allocates: one a sample takes hundreds of times the
// plane.
TEST(Jpeg2000, SmallPrecinctsDoNotTakeMemory) {
  const uint32_t side = 1024;
  const long before = peak_kilobytes();
  EXPECT_FALSE(decode_jpeg2000(codestream_without_data(side, 15, 15), side, side, {8, false}));
  EXPECT_FALSE(decode_jpeg2000(codestream_without_data(side, 0, 0), side, side, {8, false}));
  EXPECT_LT(peak_kilobytes() - before, 64 * 1024) << "for 1024 x 1024 samples";
}

// KEY-2 asks for the reversible transform; the 9/7 is floating point.
TEST(Jpeg2000, IrreversibleTransformIsRefused) {
  std::mt19937 random(8);
  const SamplePrecision precision{8, false};
  Bytes codestream = encode_jpeg2000(draw_plane(random, 40, 30, precision), precision).value();
  const Bytes cod{0xFF, 0x52};
  const auto at = std::search(codestream.begin(), codestream.end(), cod.begin(), cod.end());
  ASSERT_LT(at - codestream.begin(), 60) << "COD stands in the main header";
  ASSERT_EQ(at[13], 1) << "the 5/3 transform";
  EXPECT_TRUE(decode_jpeg2000(codestream, 40, 30, precision));
  at[13] = 0;
  EXPECT_FALSE(decode_jpeg2000(codestream, 40, 30, precision));
}

TEST(Jpeg2000, NothingAndNonsenseAreRefused) {
  EXPECT_FALSE(decode_jpeg2000({}, 4, 4, {8, false}));
  EXPECT_FALSE(decode_jpeg2000(Bytes{0xFF}, 4, 4, {8, false}));
  EXPECT_FALSE(decode_jpeg2000(Bytes{0xFF, 0x4F, 0xFF, 0x51}, 4, 4, {8, false}));
  std::mt19937 random(4);
  for (int round = 0; round < 200; ++round) {
    Bytes bytes(random() % 300);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    EXPECT_FALSE(decode_jpeg2000(bytes, 4, 4, {8, false}));
  }
}

TEST(Jpeg2000, EveryTruncationIsRefused) {
  std::mt19937 random(5);
  const SamplePrecision precision{8, false};
  const Bytes codestream = encode_jpeg2000(draw_plane(random, 20, 9, precision), precision).value();
  for (size_t length = 0; length < codestream.size(); ++length) {
    const auto part = std::span(codestream).first(length);
    EXPECT_FALSE(decode_jpeg2000(part, 20, 9, precision)) << length << " of " << codestream.size();
  }
}

// A damaged byte either goes unnoticed by JPEG 2000, which the sample CRC is for, or is refused.
TEST(Jpeg2000, DamageGivesNothingOrAPlaneOfTheRightShape) {
  std::mt19937 random(6);
  const SamplePrecision precision{8, false};
  const Bytes intact = encode_jpeg2000(draw_plane(random, 33, 17, precision), precision).value();
  int refused = 0;
  for (size_t at = 0; at < intact.size(); ++at) {
    for (const unsigned flip : {0x01u, 0x10u, 0x80u, 0xFFu}) {
      Bytes damaged = intact;
      damaged[at] = static_cast<uint8_t>(damaged[at] ^ flip);
      const auto plane = decode_jpeg2000(damaged, 33, 17, precision);
      if (!plane) {
        ++refused;
      } else {
        ASSERT_EQ(plane->samples.size(), 33u * 17u);
      }
    }
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace hmlfc
