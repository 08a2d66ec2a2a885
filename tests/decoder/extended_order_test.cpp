// Which of several faults of one block is named (CNV-7, DEC-7, EXT-5, MOT-10).
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "decoder/naive_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveBits;
using test::NaiveImage;
using test::NaiveStream;

constexpr uint32_t kAllTools = 511;

// Views in one row, groups of 1 x 3 with their references in columns 1 and 4.
StreamHeader row_of_views(std::mt19937& random, int tree_height) {
  StreamHeader header = test::draw_extended_header(random, kAllTools);
  header.rows = 1;
  header.cols = 6;
  header.width = header.height = 40;
  header.chroma_format = ChromaFormat::k444;
  header.block_log2 = 2;
  header.window = 127;
  header.tree_height = tree_height;
  header.cluster_rows = 1;
  header.cluster_cols = 255;
  header.levels.assign(static_cast<size_t>(tree_height) + 1, {1, 1, 0});
  header.levels[0] = {1, 3, 0};
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

/// The motion tiles of view 2 replaced by sound ones, and those of its references by nothing.
NaiveStream make_stream(std::mt19937& random, const StreamHeader& header, bool keyed) {
  NaiveStream stream(random, header, 0);
  for (uint32_t ty = 0; ty * (1u << header.motion_tile_log2) < 40; ++ty) {
    for (uint32_t tx = 0; tx * (1u << header.motion_tile_log2) < 40; ++tx) {
      stream.replace_record({{0, 0, 2}, test::kMotionOfY, tx, ty}, NaiveBits().put(0, 8).bytes());
    }
  }
  stream.replace_record({{0, 0, 2}, test::kMotionOfY, 0, 0}, sound_motion(keyed));
  return stream;
}

TEST(ExtendedOrder, OfOneBlockAtTheTop) {
  std::mt19937 random(1);
  StreamHeader header = row_of_views(random, 0);
  header.motion_tile_log2 = 6;
  header.disparity_grid_log2 = 5;
  NaiveStream stream = make_stream(random, header, true);
  const Bytes motion = NaiveBits().put(3, 2).put(0, 3).put(0, 4).put(1, 3).put(1, 4).bytes();
  // Faults from the first that is named to the last; each is mended in turn.
  stream.replace_record({{0, 0, 2}, test::kMotionOfY, 0, 0}, kOverrun);
  stream.replace_record({{0, 0, 1}, test::kMotionOfY, 0, 0}, bad_disparities());
  stream.replace_record({{0, 0, 2}, Plane::kY, 0, 0}, bad_residuals());
  const auto with_keys = [&](bool first_bad, bool second_bad) {
    Bytes file = stream.file();
    const StreamHeader h = Decoder::open(file)->header();
    const uint64_t top = h.sections[0].offset;
    if (first_bad) file[top + 12] ^= 1;  // sample_crc of plane Y of K0
    if (second_bad) {                    // K1's codestream begins with nonsense
      const uint64_t entry = top + 16 * 3;
      uint64_t at = 0;
      for (unsigned i = 0; i < 8; ++i) at |= uint64_t{file[entry + i]} << (8 * i);
      file[top + at] ^= 0xFF;
    }
    return file;
  };
  for (const ReferenceMode mode : {ReferenceMode::kOnDemand, ReferenceMode::kSparse}) {
    NaiveStream mended = stream;
    const auto named = [&](bool first, bool second) {
      std::swap(stream, mended);
      const std::string name = outcome(with_keys(first, second), mode);
      std::swap(stream, mended);
      return name;
    };
    EXPECT_EQ(named(true, true), "tile_overrun");
    mended.replace_record({{0, 0, 2}, test::kMotionOfY, 0, 0}, motion);
    EXPECT_EQ(named(true, true), "bad_levels");
    mended.replace_record({{0, 0, 1}, test::kMotionOfY, 0, 0},
                          NaiveBits().put(0, 13).put(0, 5).bytes());
    EXPECT_EQ(named(true, true), "bad_mode");
    mended.replace_record({{0, 0, 2}, Plane::kY, 0, 0}, NaiveBits().put(0, 2).bytes());
    EXPECT_EQ(named(true, true), "bad_top_crc");
    EXPECT_EQ(named(false, true), "bad_top_image");
    EXPECT_EQ(named(false, false), "ok");
  }
}

// Below the top the residuals of the first reference are read before those of the second.
TEST(ExtendedOrder, OfReferencesBelowTheTop) {
  std::mt19937 random(2);
  StreamHeader header = row_of_views(random, 1);
  header.motion_tile_log2 = 6;
  NaiveStream stream = make_stream(random, header, false);
  const NaiveImage first{0, 0, 1};
  const NaiveImage second{0, 0, 4};
  EXPECT_EQ(outcome(stream.file(), ReferenceMode::kOnDemand), "ok");
  stream.replace_record({second, Plane::kY, 0, 0}, bad_residuals());
  EXPECT_EQ(outcome(stream.file(), ReferenceMode::kOnDemand), "bad_mode");
  EXPECT_EQ(outcome(stream.file(), ReferenceMode::kSparse), "bad_mode");
  stream.replace_record({first, Plane::kY, 0, 0}, kOverrun);
  EXPECT_EQ(outcome(stream.file(), ReferenceMode::kOnDemand), "tile_overrun");
  EXPECT_EQ(outcome(stream.file(), ReferenceMode::kSparse), "tile_overrun");
}

// Views that are key images, and those predicted from them, do not need what is above.
TEST(ExtendedOrder, AncestorsAboveAKeyImageMayBeDamaged) {
  std::mt19937 random(3);
  StreamHeader header = row_of_views(random, 1);
  header.levels[0].key_references = 1;
  const NaiveStream stream(random, header, 0);
  Bytes file = stream.file();
  const StreamHeader h = Decoder::open(file)->header();
  for (uint64_t plane = 0; plane < 3; ++plane) {
    file[h.sections[0].offset + 16 * plane + 12] ^= 1;  // the key image of the top level
  }
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
  std::mt19937 random(4);
  StreamHeader header = row_of_views(random, 0);
  header.motion_tile_log2 = 6;
  header.disparity_grid_log2 = 5;
  NaiveStream stream = make_stream(random, header, true);
  stream.replace_record({{0, 0, 1}, test::kMotionOfY, 0, 0}, bad_disparities());
  for (unsigned choice = 0; choice <= 11; ++choice) {
    NaiveBits motion;  // explicit_bits 1
    motion.put(3, 2).put(0, 3).put(1, 4).put(0, 3).put(choice, 4);
    if (choice >= 10) motion.put(1, 1);
    if (choice == 11) motion.put(0, 1);
    stream.replace_record({{0, 0, 2}, test::kMotionOfY, 0, 0}, motion.bytes());
    const bool shared = choice >= 1 && choice <= 9;
    for (const ReferenceMode mode : {ReferenceMode::kOnDemand, ReferenceMode::kSparse}) {
      EXPECT_EQ(outcome(stream.file(), mode), shared ? "bad_levels" : "ok") << choice;
    }
  }
}

}  // namespace
}  // namespace hmlfc
