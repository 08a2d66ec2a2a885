// Which of several faults of one block is named (CNV-7, DEC-7, EXT-5, MOT-10).
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "bits/little_endian.hpp"
#include "bits/naive_bits.hpp"
#include "support/streams.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveBits;
using test::StreamParts;

// One parent for all views.
StreamHeader row_of_views(int tree_height) {
  StreamHeader header = test::row_of_views(tree_height);
  header.cluster_cols = 255;
  return header;
}

// One motion block: choice 1 with the references K0 and K1.
Bytes sound_motion(bool keyed) {
  NaiveBits bits;
  bits.put(3, 2).put(0, 3).put(0, 4).put(1, 3).put(1, 4);
  if (!keyed) bits.put(0, 1);
  return bits.bytes();
}

const Bytes kOverrun{0xFF};
// disparity_code 31.
Bytes bad_disparities() { return NaiveBits().put(0, 13).put(31, 5).bytes(); }
// residual_mode 1, level_bits 7.
Bytes bad_residuals() { return NaiveBits().put(1, 2).put(0, 6).put(7, 3).put(0, 64).bytes(); }

std::string outcome(const Bytes& file, ReferenceMode mode) {
  const OpenOptions options{.check_sections = false};
  const auto decoder = Decoder::open(file, options);
  const BlockAddress at{{0, 2}, Plane::kY, 0, 0};
  const auto block = decoder->decode_block(at, {.references = mode});
  const auto plane = decoder->decode_plane({0, 2}, Plane::kY);
  EXPECT_EQ(block.has_value(), plane.has_value());
  if (block) return "ok";
  EXPECT_EQ(error_name(block.error().code), error_name(plane.error().code));
  return std::string(error_name(block.error().code));
}

TEST(ExtendedOrder, OfOneBlockAtTheTop) {
  StreamParts stream(row_of_views(0));
  // Faults from the first that is named to the last; each is mended in turn.
  Bytes& motion = stream.motion_tile(0, {0, 2}) = kOverrun;
  Bytes& disparities = stream.motion_tile(0, {0, 1}) = bad_disparities();
  Bytes& residuals = stream.tile(0, {0, 2}, Plane::kY) = bad_residuals();
  const uint64_t second_codestream = load_le<uint64_t>(stream.top, 16 * 3);  // plane Y of K1
  stream.top[12] ^= 1;  // sample_crc of plane Y of K0
  stream.top[second_codestream] ^= 0xFF;
  const auto expect_named = [&](const char* name) {
    for (const ReferenceMode mode : {ReferenceMode::kOnDemand, ReferenceMode::kSparse}) {
      EXPECT_EQ(outcome(stream.file(), mode), name);
    }
  };
  expect_named("tile_overrun");
  motion = sound_motion(true);
  expect_named("bad_levels");
  disparities = NaiveBits().put(0, 13).put(0, 5).bytes();
  expect_named("bad_mode");
  residuals.clear();
  expect_named("bad_top_crc");
  stream.top[12] ^= 1;
  expect_named("bad_top_image");
  stream.top[second_codestream] ^= 0xFF;
  expect_named("ok");
}

// Below the top the residuals of the first reference are read before those of the second.
TEST(ExtendedOrder, OfReferencesBelowTheTop) {
  StreamParts stream(row_of_views(1));
  stream.motion_tile(0, {0, 2}) = sound_motion(false);
  EXPECT_EQ(outcome(stream.file(), ReferenceMode::kOnDemand), "ok");
  for (const auto& [col, record, name] :
       {std::tuple{4u, bad_residuals(), "bad_mode"}, std::tuple{1u, kOverrun, "tile_overrun"}}) {
    stream.tile(0, {0, col}, Plane::kY) = record;
    EXPECT_EQ(outcome(stream.file(), ReferenceMode::kOnDemand), name);
    EXPECT_EQ(outcome(stream.file(), ReferenceMode::kSparse), name);
  }
}

// Views that are key images, and those predicted from them, do not need what is above.
TEST(ExtendedOrder, AncestorsAboveAKeyImageMayBeDamaged) {
  StreamHeader header = row_of_views(1);
  header.levels[0].key_references = 1;
  StreamParts stream(header);
  for (size_t plane = 0; plane < 3; ++plane) {
    stream.top[16 * plane + 12] ^= 1;  // the key image of the top level
  }
  const Bytes file = stream.file();
  const OpenOptions options{.check_sections = false};
  const auto decoder = Decoder::open(file, options);
  ASSERT_TRUE(decoder.has_value());
  for (uint32_t col = 0; col < 6; ++col) {
    const auto view = decoder->decode_view({0, col});
    const bool key = col == 1 || col == 4;
    EXPECT_EQ(view.has_value(), key) << col << ": " << (view ? "" : to_string(view.error()));
    const auto block = decoder->decode_block({{0, col}, Plane::kCg, 3, 3});
    EXPECT_EQ(block.has_value(), key) << col;
    EXPECT_FALSE(decoder->decode_view({0, col}, 1).has_value());
  }
}

// Damaged disparities are named where a block shares one, and nowhere else (MOT-5, MOT-6).
TEST(ExtendedOrder, OnlySharedDisparitiesAreRead) {
  StreamParts stream(row_of_views(0));
  stream.motion_tile(0, {0, 1}) = bad_disparities();
  for (unsigned choice = 0; choice <= 11; ++choice) {
    NaiveBits motion;  // explicit_bits 1
    motion.put(3, 2).put(0, 3).put(1, 4).put(0, 3).put(choice, 4);
    if (choice >= 10) motion.put(1, 1);
    if (choice == 11) motion.put(0, 1);
    stream.motion_tile(0, {0, 2}) = motion.bytes();
    const bool shared = choice >= 1 && choice <= 9;
    for (const ReferenceMode mode : {ReferenceMode::kOnDemand, ReferenceMode::kSparse}) {
      EXPECT_EQ(outcome(stream.file(), mode), shared ? "bad_levels" : "ok") << choice;
    }
  }
}

}  // namespace
}  // namespace hmlfc
