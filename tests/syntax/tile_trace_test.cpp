// What a sink is told about a record written by hand: every field with its address (CNV-4, TIL-1).
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bits/naive_bits.hpp"
#include "syntax/record_helpers.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {
namespace {

using test::NaiveBits;

// Window 3: v = 3 bits, K = 6 (8 levels), c = 3 bits.
const TileContext kContext{.predictive = true, .window = 3, .block_samples = 4};

NaiveBits record() {
  NaiveBits bits;
  bits.put(3, 2).put(2, 2);                      // modes: quads, raw
  bits.put(0b101, 16).put(0b1000, 4).put(1, 4);  // motion: blocks 3 and 8
  bits.put(0b1001, 64);                          // residual: blocks 0 and 3
  bits.put(2, 2);                                // one sign a block
  bits.put(1, 3).put(3, 3);                      // min_x = -2, 4 levels
  bits.put(5, 3).put(1, 3);                      // min_y = 2, 2 levels
  bits.put(1, 1).put(0, 1);                      // block 3 -, block 8 +
  bits.put(3, 2).put(1, 2);                      // dx: -2 + 3 = 1, -2 + 1 = -1
  bits.put(1, 1).put(0, 1);                      // dy: 2 + 1 = 3, 2
  bits.put(1, 6).put(1, 3).put(4, 4);            // base 1, 1 bit of level, 4 of bias
  bits.put(0, 1).put_signed(-3, 4);              // block 0: code 1, 2 levels
  bits.put(1, 1).put_signed(7, 4);               // block 3: code 2, 3 levels
  bits.put(0b1010, 4);                           // block 0's four values
  bits.put(0, 7);                                // block 3's four trits
  return bits;
}

TEST(TileTrace, EveryFieldOfABlockWithAllOfThem) {
  const std::vector<uint8_t> bytes = record().bytes();
  test::FieldRecorder recorder;
  FieldCursor cursor(BitString(bytes), 8 * test::kRecordAt, Probe{&recorder, nullptr, {}});
  const auto head = read_tile_head(cursor, kContext);
  ASSERT_TRUE(head.has_value()) << to_string(head.error());
  const auto entry = read_block_entry(cursor, *head, kContext, 3);
  ASSERT_TRUE(entry.has_value()) << to_string(entry.error());
  EXPECT_EQ(entry->state, BlockState::kMotionResidual);
  EXPECT_TRUE(entry->negative);
  EXPECT_EQ(entry->dx, 1);
  EXPECT_EQ(entry->dy, 3);
  EXPECT_EQ(entry->levels.count, 3u);
  EXPECT_EQ(entry->bias, 7);
  EXPECT_EQ(recorder.text(),
            "TIL-1 motion_mode@0:2=3\nTIL-1 residual_mode@2:2=2\nTIL-3 quad_mask@4:16=5\n"
            "TIL-3 quad_blocks@20:4=8\nTIL-3 quad_blocks@24:4=1\nTIL-3 mask@28:64=9\n"
            "TIL-6 sign_mode@92:2=2\nTIL-6 min_x@94:3=-2\nTIL-6 codes_x@97:3=3\n"
            "TIL-6 min_y@100:3=2\nTIL-6 codes_y@103:3=1\nTIL-8 level_base@114:6=1\n"
            "TIL-8 level_bits@120:3=1\nTIL-8 bias_bits@123:4=4\nTIL-6 sign@106:1=1\n"
            "TIL-7 dx@108:2=1\nTIL-7 dy@112:1=3\nTIL-8 level_delta@127:1=0\n"
            "TIL-8 level_delta@132:1=1\nTIL-8 bias@133:4=7\n");
  EXPECT_EQ(entry->values_at, 137u + 4u) << "behind the four values of block 0";
}

TEST(TileTrace, StepsAreTheBlockHeadersBefore) {
  const std::vector<uint8_t> bytes = record().bytes();
  for (const auto& [k, steps] : {std::pair{0u, 0u}, {3u, 1u}, {8u, 0u}, {1u, 0u}}) {
    AccessCounts counts;
    FieldCursor cursor(BitString(bytes), 8 * test::kRecordAt, Probe{nullptr, &counts, {}});
    const auto head = read_tile_head(cursor, kContext);
    ASSERT_TRUE(head.has_value());
    ASSERT_TRUE(read_block_entry(cursor, *head, kContext, k).has_value());
    EXPECT_EQ(counts.steps, steps) << k;
  }
}

}  // namespace
}  // namespace hmlfc
