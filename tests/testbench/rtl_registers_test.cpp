// The registers at the pins: of every Verilated unit of this build, and of the stand-in.
#include <gtest/gtest.h>

#include "systemc/suite.hpp"
#include "testbench/test_bench.hpp"
#include "unit/stand_in.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint32_t kSpace = 0x1000;

std::vector<UnitMaker> all_units() {
  auto makers = rtl_units();
  makers.push_back({"stand-in", {2, 12, 16, 16}, &StandIn::make});
  return makers;
}

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

TEST(Registers, OtherWordsReadZeroAndIgnoreWrites) {
  Bench& bench = test_bench();
  for (const UnitMaker& maker : all_units()) {
    bench.attach(maker.make(maker.parameters));
    expect_other_words_are_zero(bench);
    EXPECT_FALSE(bench.findings().first());
  }
}

uint32_t status_after_load(Bench& bench) {
  uint32_t status = 0;
  do {
    status = bench.read(reg::kStatus);
  } while ((status & reg::kLoading) != 0 && !bench.findings().first());
  return status;
}

// DISABLE in any state of LOAD: the unit is not ready when it has ended, and is after another one.
TEST(Registers, DisableDuringLoadHolds) {
  Bench& bench = test_bench();
  for (const UnitMaker& maker : all_units()) {
    const auto bytes = suite_stream(0, maker.parameters.block_size());
    StreamImage image(bytes, maker.parameters);
    bench.attach(maker.make(maker.parameters));
    image.load_into(bench);
    ASSERT_EQ(bench.read(reg::kStatus), reg::kReady | reg::kIdle);
    unsigned during_load = 0;
    for (uint64_t clocks = 0; clocks < 600; clocks += 23) {
      bench.write(reg::kControl, reg::kLoad);
      bench.run_clocks(clocks);
      during_load += (bench.read(reg::kStatus) & reg::kLoading) != 0;
      bench.write(reg::kControl, reg::kDisable);
      EXPECT_EQ(status_after_load(bench), reg::kIdle) << clocks << " clocks after LOAD";
      bench.write(reg::kControl, reg::kLoad | reg::kDisable);
      EXPECT_EQ(status_after_load(bench), reg::kReady | reg::kIdle) << "LOAD has the last word";
    }
    EXPECT_GE(during_load, 10u);
    EXPECT_FALSE(bench.findings().first());
  }
}

}  // namespace
}  // namespace hmlfc::tb
