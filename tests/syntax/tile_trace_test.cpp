// What a sink is told about a record written by hand: every field with its address (CNV-4, TIL-1).
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bits/naive_bits.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {
namespace {

using test::NaiveBits;

struct Field {
  std::string clause;
  std::string name;
  uint64_t bit;
  unsigned bits;
  int64_t value;
  friend bool operator==(const Field&, const Field&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Field& field) {
    return out << field.clause << ' ' << field.name << " = " << field.value << " in " << field.bits
               << " bits at " << field.bit;
  }
};

class Recorder final : public TraceSink {
 public:
  void on_field(const FieldRecord& record) override {
    EXPECT_EQ(record.section, Section::kTile);
    fields_.push_back({std::string(record.clause), std::string(record.name), record.bit,
                       record.bits, record.value});
  }
  void on_stage(const StageRecord&) override {}
  const std::vector<Field>& fields() const { return fields_; }

 private:
  std::vector<Field> fields_;
};

// Window 3: v = 3 bits, K = 6 (8 levels), c = 3 bits.
constexpr uint64_t kFileBit = 8 * 777;

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
  Recorder recorder;
  FieldCursor cursor(BitString(bytes), kFileBit, Probe{&recorder, nullptr, {}});
  TileContext context;
  context.predictive = true;
  context.window = 3;
  context.block_samples = 4;
  const auto head = read_tile_head(cursor, context);
  ASSERT_TRUE(head.has_value()) << to_string(head.error());
  const auto entry = read_block_entry(cursor, *head, context, 3);
  ASSERT_TRUE(entry.has_value()) << to_string(entry.error());
  EXPECT_EQ(entry->state, BlockState::kMotionResidual);
  EXPECT_TRUE(entry->negative);
  EXPECT_EQ(entry->dx, 1);
  EXPECT_EQ(entry->dy, 3);
  EXPECT_EQ(entry->levels.count, 3u);
  EXPECT_EQ(entry->bias, 7);
  const uint64_t at = kFileBit;
  const std::vector<Field> expected{
      {"TIL-1", "motion_mode", at + 0, 2, 3},   {"TIL-1", "residual_mode", at + 2, 2, 2},
      {"TIL-3", "quad_mask", at + 4, 16, 5},    {"TIL-3", "quad_blocks", at + 20, 4, 8},
      {"TIL-3", "quad_blocks", at + 24, 4, 1},  {"TIL-3", "mask", at + 28, 64, 9},
      {"TIL-6", "sign_mode", at + 92, 2, 2},    {"TIL-6", "min_x", at + 94, 3, -2},
      {"TIL-6", "codes_x", at + 97, 3, 3},      {"TIL-6", "min_y", at + 100, 3, 2},
      {"TIL-6", "codes_y", at + 103, 3, 1},     {"TIL-8", "level_base", at + 114, 6, 1},
      {"TIL-8", "level_bits", at + 120, 3, 1},  {"TIL-8", "bias_bits", at + 123, 4, 4},
      {"TIL-6", "sign", at + 106, 1, 1},        {"TIL-7", "dx", at + 108, 2, 1},
      {"TIL-7", "dy", at + 112, 1, 3},          {"TIL-8", "level_delta", at + 127, 1, 0},
      {"TIL-8", "level_delta", at + 132, 1, 1}, {"TIL-8", "bias", at + 133, 4, 7}};
  EXPECT_EQ(recorder.fields(), expected);
  EXPECT_EQ(entry->values_at, 137u + 4u) << "behind the four values of block 0";
}

TEST(TileTrace, StepsAreTheBlockHeadersBefore) {
  const std::vector<uint8_t> bytes = record().bytes();
  TileContext context;
  context.predictive = true;
  context.window = 3;
  context.block_samples = 4;
  for (const auto& [k, steps] : {std::pair{0u, 0u}, {3u, 1u}, {8u, 0u}, {1u, 0u}}) {
    AccessCounts counts;
    FieldCursor cursor(BitString(bytes), kFileBit, Probe{nullptr, &counts, {}});
    const auto head = read_tile_head(cursor, context);
    ASSERT_TRUE(head.has_value());
    ASSERT_TRUE(read_block_entry(cursor, *head, context, k).has_value());
    EXPECT_EQ(counts.steps, steps) << k;
  }
}

}  // namespace
}  // namespace hmlfc
