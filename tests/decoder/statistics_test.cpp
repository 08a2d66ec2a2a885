// Where the bytes of a stream go, and the states of its blocks (TIL-1, TIL-5, MOT-3 to MOT-6).
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "decoder/naive_stream.hpp"

namespace hmlfc {
namespace {

using test::NaiveStream;

void check_statistics(const NaiveStream& stream) {
  const test::Bytes file = stream.file();
  const auto decoder = Decoder::open(file);
  ASSERT_TRUE(decoder.has_value());
  const auto found = decoder->statistics();
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_EQ(found->states, stream.states());
  const SectionBytes& sections = found->sections;
  EXPECT_EQ(sections.motion, stream.motion_bits() / 8);
  EXPECT_EQ(sections.residual, stream.residual_bits() / 8);
  EXPECT_EQ(sections.top, decoder->header().sections[0].size);
  EXPECT_EQ(sections.other, 0u);
  EXPECT_EQ(sections.total(), file.size());
}

TEST(Statistics, RandomStreams) {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    const NaiveStream stream(random, test::draw_stream_header(random), 1 + round % 4);
    ASSERT_NO_FATAL_FAILURE(check_statistics(stream)) << "round " << round;
  }
}

TEST(Statistics, RandomExtendedStreams) {
  std::mt19937 random(2);
  for (int round = 0; round < 80; ++round) {
    const StreamHeader header = test::draw_extended_header(random, test::draw_flags(random));
    const NaiveStream stream(random, header, 1 + round % 4);
    ASSERT_NO_FATAL_FAILURE(check_statistics(stream)) << "round " << round;
  }
}

// A motion tile that cannot be read is an error even where no residual stands.
TEST(Statistics, DamagedMotionTiles) {
  std::mt19937 random(3);
  StreamHeader header = test::draw_extended_header(random, 2);
  header.rows = header.cols = 3;
  header.tree_height = 0;
  header.levels = {{3, 3}};
  NaiveStream stream(random, header, 0);
  stream.replace_record({{0, 0, 0}, test::kMotionOfY, 0, 0}, {0xFF});
  const test::Bytes file = stream.file();
  const auto found = Decoder::open(file)->statistics();
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(error_name(found.error().code), "tile_overrun");
}

// Without shared_disparity the motion tiles of reference images are never read (MOT-6).
TEST(Statistics, MotionTilesOfReferencesWithoutDisparities) {
  std::mt19937 random(4);
  StreamHeader header = test::draw_extended_header(random, 2);
  header.rows = header.cols = 3;
  header.tree_height = 0;
  header.levels = {{3, 3}};
  NaiveStream stream(random, header, 0);
  stream.replace_record({{0, 1, 1}, test::kMotionOfY, 0, 0}, {0xFF});
  const test::Bytes file = stream.file();
  const auto found = Decoder::open(file)->statistics();
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_EQ(found->sections.motion, 0u);
}

}  // namespace
}  // namespace hmlfc
