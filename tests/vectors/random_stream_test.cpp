// Random streams are valid, the same for the same seed, and reach all syntax.
#include "vectors/field_stream.hpp"

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "syntax/header.hpp"

namespace hmlfc::vectors {
namespace {

constexpr uint64_t kStreams = 150;
constexpr Limits kSmall{4, 30, 12, 127, 3, true, true, 7};

TEST(RandomStream, EveryViewDecodes) {
  for (uint64_t seed = 0; seed < kStreams; ++seed) {
    SCOPED_TRACE(seed);
    const auto bytes = random_stream(seed, kSmall);
    const auto decoder = Decoder::open(bytes);
    ASSERT_TRUE(decoder) << to_string(decoder.error());
    const auto done = decoder->decode_all([](ViewPos, RgbImage&&) {}, {.threads = 1});
    ASSERT_TRUE(done) << to_string(done.error());
  }
}

TEST(RandomStream, SameBytesForTheSameSeed) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(random_stream(seed, kSmall), random_stream(seed, kSmall));
    EXPECT_NE(random_stream(seed, kSmall), random_stream(seed + 1, kSmall));
  }
}

TEST(RandomStream, ReachesEveryHeaderField) {
  unsigned block_sizes = 0;
  unsigned formats = 0;
  unsigned depths = 0;
  unsigned heights = 0;
  uint32_t set = 0;
  uint32_t clear = 0;
  bool one_view = false;
  bool keyed = false;
  for (uint64_t seed = 0; seed < kStreams; ++seed) {
    const auto header = parse_header(random_stream(seed, kSmall)).value();
    block_sizes |= 1u << header.block_log2;
    formats |= 1u << static_cast<unsigned>(header.chroma_format);
    depths |= 1u << header.depth;
    heights |= 1u << header.tree_height;
    set |= header.feature_flags;
    if (header.profile == Profile::kExtended) clear |= ~header.feature_flags;
    one_view = one_view || header.rows * header.cols == 1;
    for (const LevelEntry& level : header.levels) keyed = keyed || level.key_references == 1;
  }
  EXPECT_EQ(block_sizes, 0b1110u);
  EXPECT_EQ(formats, 0b11u);
  EXPECT_EQ(depths, 0b11111u << 8);
  EXPECT_EQ(heights, 0b1111u);
  EXPECT_EQ(set, (1u << kFeatureCount) - 1);
  EXPECT_EQ(clear & ((1u << kFeatureCount) - 1), (1u << kFeatureCount) - 1);
  EXPECT_TRUE(one_view);
  EXPECT_TRUE(keyed);
}

TEST(RandomStream, KeepsToItsLimits) {
  const Limits limits{2, 9, 9, 5, 1, false, true, 4};
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const auto header = parse_header(random_stream(seed, limits)).value();
    EXPECT_LE(std::max(header.rows, header.cols), 2u);
    EXPECT_LE(std::max(header.width, header.height), 9u);
    EXPECT_LE(header.depth, 9);
    EXPECT_LE(header.window, 5);
    EXPECT_LE(header.tree_height, 1);
    EXPECT_EQ(header.profile, Profile::kExtended);
    EXPECT_EQ(header.block_log2, 3u);
  }
}

}  // namespace
}  // namespace hmlfc::vectors
