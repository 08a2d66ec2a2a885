// Where the bytes of a stream go, and the states of its blocks (TIL-1, TIL-5, MOT-3 to MOT-6).
#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "bits/naive_bits.hpp"
#include "decoder/golden/block_walk.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveBits;
using test::StreamParts;

BlockState state_of(const StreamView& stream, const BlockSite& site) {
  const Probe probe{nullptr, nullptr, site};
  const BlockEntry entry = walk_to_block(stream, probe).value().entry;
  const bool reference = stream.geometry.is_reference(site.level, {site.image_row, site.image_col});
  if (reference || !stream.header.has(Feature::kMotionTiles)) return entry.state;
  const bool motion = walk_to_motion(stream, probe).value().count > 0;
  if (motion) return entry.has_residual() ? BlockState::kMotionResidual : BlockState::kMotion;
  return entry.has_residual() ? BlockState::kResidual : BlockState::kZero;
}

/// Blocks by state, by one walk for each block.
std::array<uint64_t, 4> states_of(const StreamView& stream) {
  std::array<uint64_t, 4> states{};
  for (int level = 0; level <= stream.geometry.top(); ++level) {
    const LevelShape& shape = stream.geometry.level(level);
    for (uint32_t image = 0; image < shape.images(); ++image) {
      const ImagePos at{image / shape.cols, image % shape.cols};
      if (stream.geometry.is_key(level, at)) continue;
      for (const Plane plane : kPlanes) {
        const PlaneShape& blocks = stream.geometry.plane(plane);
        for (uint32_t i = 0; i < blocks.blocks_x * blocks.blocks_y; ++i) {
          const BlockSite site{
              level, at.row, at.col, plane, i % blocks.blocks_x, i / blocks.blocks_x};
          ++states[static_cast<size_t>(state_of(stream, site))];
        }
      }
    }
  }
  return states;
}

TEST(Statistics, RandomStreams) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const Bytes file = vectors::random_stream(seed, {});
    const StreamHeader header = parse_header(file).value();
    const auto found = Decoder::open(file)->statistics();
    ASSERT_TRUE(found.has_value()) << to_string(found.error());
    EXPECT_EQ(found->states, states_of({file, header, Geometry(header)})) << "seed " << seed;
    EXPECT_EQ(found->sections.top, header.sections[0].size);
    EXPECT_EQ(found->sections.other, header.rig.size);
    EXPECT_EQ(found->sections.total(), file.size());
  }
}

/// 3 x 3 views of one group, whose reference is view (1, 1).
StreamHeader nine_views(uint32_t flags) {
  StreamHeader header = test::some_header(0);
  if (flags != 0) header.profile = Profile::kExtended;
  header.feature_flags = flags;
  header.rows = header.cols = 3;
  header.levels = {{3, 3}};
  header.motion_tile_log2 = flags != 0 ? 7 : 0;
  if (header.has(Feature::kSharedDisparity)) header.disparity_grid_log2 = 5;
  return header;
}

Result<StreamStatistics> statistics_of(const StreamParts& parts) {
  const Bytes file = parts.file();
  return Decoder::open(file)->statistics();
}

TEST(Statistics, BitsOfVectorsAndResiduals) {
  StreamParts parts(nine_views(0));
  NaiveBits record;
  record.put(2, 2).put(2, 2).put(1, 64).put(1, 64);              // block 0 has both
  record.put(2, 2).put(16, 6).put(0, 4).put(16, 6).put(0, 4);    // sign_mode to codes_y
  record.put(1, 1);                                              // its sign
  record.put(1, 6).put(0, 3).put(4, 4).put(3, 4).put(0xF0, 16);  // level_base to 16 values of 1 bit
  for (const uint32_t col : {0u, 1u, 2u}) {
    parts.tile(0, {0, col}, Plane::kY) = record.bytes();
  }
  const auto sections = statistics_of(parts)->sections;
  EXPECT_EQ(sections.motion, 3u * (2 + 6 + 4 + 6 + 4 + 1) / 8);
  EXPECT_EQ(sections.residual, 3u * (6 + 3 + 4 + 4 + 16) / 8);
}

TEST(Statistics, BitsOfMotionTilesAndDisparities) {
  StreamParts parts(nine_views(2 + 8));
  for (const uint32_t col : {0u, 1u, 2u}) {  // one entry, choice 0; 4 x 2 indices of 1 level
    parts.motion_tile(0, {0, col}) = NaiveBits().put(3, 2).put(0, 3).put(0, 4).put(0, 4).bytes();
  }
  parts.motion_tile(0, {1, 1}) = NaiveBits().put(0, 13).put(1, 5).put(0x55, 8).bytes();
  const auto sections = statistics_of(parts)->sections;
  EXPECT_EQ(sections.motion, (3u * 13 + 18 + 8) / 8);
}

// A motion tile that cannot be read is an error even where no residual stands; but without
// shared_disparity those of reference images are never read (MOT-6).
TEST(Statistics, DamagedMotionTiles) {
  for (const uint32_t place : {0u, 1u}) {
    StreamParts parts(nine_views(2));
    parts.motion_tile(0, {place, place}) = {0xFF};
    const auto found = statistics_of(parts);
    ASSERT_EQ(found.has_value(), place == 1);
    if (found) {
      EXPECT_EQ(found->sections.motion, 0u);
    } else {
      EXPECT_EQ(error_name(found.error().code), "tile_overrun");
    }
  }
}

}  // namespace
}  // namespace hmlfc
