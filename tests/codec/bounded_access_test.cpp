// The bounds of BND-1 and BND-2, counted on cold random blocks.
#include <gtest/gtest.h>

#include <algorithm>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "scenes/test_light_fields.hpp"
#include "support/streams.hpp"

namespace hmlfc {
namespace {

// BND-1: fields and serial additions of one walk. decoder/extended_bounds_test.cpp has BND-3.
constexpr uint64_t kFieldsPerWalk = 182;
constexpr uint64_t kStepsPerWalk = 63;

// Decodes `blocks` random blocks of profile main and checks each against the bounds.
void check_random_blocks(const test::RandomCase& made, uint32_t seed, int blocks) {
  const LightField field = test::textured_light_field(made.shape, seed, made.noise);
  const auto encoded = encode(field, made.params);
  const auto decoder = Decoder::open(encoded->bytes);
  const StreamHeader& header = decoder->header();
  const auto max_walks = static_cast<uint64_t>(5 * header.tree_height + 1);
  vectors::Random random(seed);
  for (int block = 0; block < blocks; ++block) {
    AccessCounts counts;
    const BlockAddress address = test::draw_block(random, *decoder);
    EXPECT_TRUE(decoder->decode_block(address, {.counts = &counts}).has_value());
    EXPECT_LE(counts.walks, max_walks);
    EXPECT_LE(counts.fields, counts.walks * kFieldsPerWalk);
    EXPECT_LE(counts.steps, counts.walks * kStepsPerWalk);
  }
}

TEST(BoundedAccess, RandomStreamsStayWithinTheStatedBounds) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    auto made = test::random_case(seed);
    made.params.main.threshold_ref /= 8;
    made.params.main.threshold_pred /= 8;
    check_random_blocks(made, seed, 40);
  }
}

// The cost of a block does not grow with the grid or the picture.
TEST(BoundedAccess, CostDoesNotGrowWithTheLightField) {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.main.threshold_ref = 0;
  params.main.threshold_pred = 0;
  params.tree_height = 1;
  params.window = 4;
  const auto worst_fields = [&](const LightFieldShape& shape) {
    const LightField field = test::textured_light_field(shape, 4, 60);
    const auto encoded = encode(field, params);
    const auto decoder = Decoder::open(encoded->bytes);
    uint64_t worst = 0;
    for (uint32_t bx = 0; bx < 16; ++bx) {
      for (uint32_t by = 0; by < 8; ++by) {
        AccessCounts counts;
        const auto block = decoder->decode_block({{1, 1}, Plane::kY, bx, by}, {.counts = &counts});
        EXPECT_TRUE(block.has_value());
        worst = std::max(worst, counts.fields);
      }
    }
    return worst;
  };
  const uint64_t small = worst_fields({2, 2, 64, 32, 8});
  const uint64_t large = worst_fields({12, 12, 256, 128, 8});
  EXPECT_LE(small, 6 * kFieldsPerWalk);
  EXPECT_LE(large, 6 * kFieldsPerWalk);
}

}  // namespace
}  // namespace hmlfc
