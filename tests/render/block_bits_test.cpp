// Sets of blocks, a word at a time, against single blocks.
#include <gtest/gtest.h>

#include "render/block_bits.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

// A set that holds about one block in `one_in`.
BlockBits random_set(test::Random& random, uint32_t columns, uint32_t rows, uint32_t one_in) {
  BlockBits set(columns, rows);
  for (uint32_t by = 0; by < rows; ++by) {
    for (uint32_t bx = 0; bx < columns; ++bx) {
      if (random() % one_in == 0) set.set(bx, by);
    }
  }
  return set;
}

TEST(BlockBits, HalvesHoldABlockForEachOfFourBlocks) {
  test::Random random(1);
  for (const uint32_t columns : {1u, 2u, 63u, 64u, 65u, 127u, 128u, 129u, 257u}) {
    const uint32_t rows = 1 + random() % 7;
    const BlockBits finer = random_set(random, columns, rows, 9);
    BlockBits halves = random_set(random, (columns + 1) / 2, (rows + 1) / 2, 2);
    halves.set_halves(finer);
    BlockBits expected((columns + 1) / 2, (rows + 1) / 2);
    for (uint32_t by = 0; by < rows; ++by) {
      for (uint32_t bx = 0; bx < columns; ++bx) {
        if (finer.has(bx, by)) expected.set(bx / 2, by / 2);
      }
    }
    for (uint32_t by = 0; by < (rows + 1) / 2; ++by) {
      for (uint32_t bx = 0; bx < (columns + 1) / 2; ++bx) {
        ASSERT_EQ(halves.has(bx, by), expected.has(bx, by)) << columns << ": " << bx << ", " << by;
      }
    }
    EXPECT_EQ(halves.count(), expected.count());
  }
}

TEST(BlockBits, RangesAreTheirBlocks) {
  for (const uint32_t begin : {0u, 1u, 62u, 63u, 64u, 65u, 128u}) {
    for (const uint32_t end : {1u, 63u, 64u, 65u, 66u, 127u, 128u, 129u, 200u}) {
      if (end <= begin) continue;
      BlockBits set(200, 2);
      set.set_range(begin, end, 1);
      EXPECT_EQ(set.count(), end - begin);
      EXPECT_TRUE(set.has_range(begin, end, 1));
      EXPECT_FALSE(set.has_range(begin, end, 0));
      EXPECT_TRUE(set.has(begin, 1) && set.has(end - 1, 1));
      EXPECT_FALSE(begin > 0 && set.has_range(begin - 1, end, 1));
      EXPECT_FALSE(end < 200 && set.has_range(begin, end + 1, 1));
    }
  }
}

}  // namespace
}  // namespace hmlfc
