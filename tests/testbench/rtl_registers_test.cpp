// The registers of every Verilated unit of this build, at the pins of the top.
#include <gtest/gtest.h>

#include "systemc/suite.hpp"
#include "testbench/test_bench.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint32_t kSpace = 0x1000;

bool is_register(uint32_t offset) {
  const bool gap = offset == 0x28 || offset == 0x2c || offset == 0x34;
  return offset <= 0x64 && !gap;
}

bool is_written(uint32_t offset) {
  return offset == reg::kControl ||
         (offset >= reg::kStreamBase && offset < reg::kReferenceBase + 8);
}

// What each word of the space reads as, after 1s were written to all but those that are for it.
void expect_other_words_are_zero(Bench& bench) {
  for (uint32_t word = 0; word < 6; ++word) bench.write(reg::kStreamBase + 4 * word, word + 1);
  for (uint32_t offset = 0; offset < kSpace; offset += 4) {
    if (!is_written(offset)) bench.write(offset, ~uint32_t{0});
  }
  const UnitParameters unit = bench.unit().parameters();
  for (uint32_t offset = 0; offset < kSpace; offset += 4) {
    const uint32_t value = bench.read(offset);
    if (!is_register(offset)) {
      ASSERT_EQ(value, 0u) << std::hex << offset;
    }
    if (offset >= reg::kStreamBase && offset < reg::kReferenceBase + 8) {
      ASSERT_EQ(value, (offset - reg::kStreamBase) / 4 + 1) << std::hex << offset;
    }
  }
  EXPECT_EQ(bench.read(reg::kId), reg::kIdValue);
  EXPECT_EQ(bench.read(reg::kParameters),
            reg::parameters(unit.block_log2, unit.max_depth, unit.beat_bytes));
  EXPECT_EQ(bench.read(reg::kStatus), reg::kIdle) << "no LOAD began";
}

TEST(RtlRegisters, OtherWordsReadZeroAndIgnoreWrites) {
  Bench& bench = test_bench();
  for (const UnitMaker& maker : rtl_units()) {
    bench.attach(maker.make(maker.parameters));
    expect_other_words_are_zero(bench);
    EXPECT_FALSE(bench.findings().first());
  }
}

}  // namespace
}  // namespace hmlfc::tb
