// The registers at the pins of every Verilated decode unit of this build.
#include <gtest/gtest.h>

#include "stimulus/random_stream.hpp"
#include "stimulus/sequences.hpp"
#include "systemc/suite.hpp"
#include "testbench/test_bench.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint32_t kSpace = 0x1000;

// Calls test(bench, image) with each unit at the bench, and a stream for it.
template <typename Test>
void for_each_unit(const Test& test) {
  Bench& bench = test_bench();
  for (const UnitMaker& maker : rtl_units()) {
    const auto bytes = suite_stream(0, maker.parameters.block_size());
    StreamImage image(bytes, maker.parameters);
    bench.attach(maker.make(maker.parameters, nullptr));
    test(bench, image);
    EXPECT_FALSE(bench.findings().first());
  }
}

bool is_register(uint32_t offset) {
  const bool gap = offset == 0x28 || offset == 0x2c || offset == 0x34;
  return offset <= 0x64 && !gap;
}

bool is_written(uint32_t offset) {
  return offset == HMLFC_REG_CONTROL ||
         (offset >= HMLFC_REG_STREAM_BASE && offset < HMLFC_REG_REFERENCE_BASE + 8);
}

// What each word of the space reads as, after 1s were written to all but those that are for it.
void expect_other_words_are_zero(Bench& bench) {
  for (uint32_t word = 0; word < 6; ++word) bench.write(HMLFC_REG_STREAM_BASE + 4 * word, word + 1);
  for (uint32_t offset = 0; offset < kSpace; offset += 4) {
    if (!is_written(offset)) bench.write(offset, ~uint32_t{0});
  }
  const UnitParameters unit = bench.unit().parameters();
  for (uint32_t offset = 0; offset < kSpace; offset += 4) {
    const uint32_t value = bench.read(offset);
    if (!is_register(offset)) {
      ASSERT_EQ(value, 0u) << std::hex << offset;
    }
    if (offset >= HMLFC_REG_STREAM_BASE && offset < HMLFC_REG_REFERENCE_BASE + 8) {
      ASSERT_EQ(value, (offset - HMLFC_REG_STREAM_BASE) / 4 + 1) << std::hex << offset;
    }
  }
  EXPECT_EQ(bench.read(HMLFC_REG_ID), HMLFC_REG_ID_RESET);
  EXPECT_EQ(bench.read(HMLFC_REG_PARAMETERS),
            reg::parameters(unit.block_log2, unit.max_depth, unit.beat_bytes));
  EXPECT_EQ(bench.read(HMLFC_REG_STATUS), HMLFC_REG_STATUS_RESET) << "no LOAD began";
}

TEST(Registers, OtherWordsReadZeroAndIgnoreWrites) {
  for_each_unit([](Bench& bench, StreamImage&) { expect_other_words_are_zero(bench); });
}

// The high word that goes with a low word is read after it, whatever happens between.
TEST(Registers, LowWordKeepsItsHighWord) {
  for_each_unit([](Bench& bench, StreamImage& image) {
    image.load_into(bench);
    const Request missing{4000, 3, 0, 1 << 14, kRgb, 0, true};  // with bits in both words
    bench.run(listed_requests({missing}), image.oracle(), {}, 1);
    EXPECT_EQ(bench.read(HMLFC_REG_ERROR_ADDRESS), static_cast<uint32_t>(missing.word()));
    bench.write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_CLEAR_MASK);
    EXPECT_EQ(bench.read(HMLFC_REG_ERROR_ADDRESS_HIGH), missing.word() >> 32) << "of the word read";
    EXPECT_EQ(bench.read(HMLFC_REG_ERROR_ADDRESS_HIGH), 0u) << "kept for one read";
  });
}

uint32_t status_after_load(Bench& bench) {
  uint32_t status = 0;
  do {
    status = bench.read(HMLFC_REG_STATUS);
  } while ((status & HMLFC_REG_STATUS_LOADING_MASK) != 0 && !bench.findings().first());
  return status;
}

// DISABLE in any state of LOAD: the unit is not ready when it has ended, and is after another one.
TEST(Registers, DisableDuringLoadHolds) {
  for_each_unit([](Bench& bench, StreamImage& image) {
    image.load_into(bench);
    ASSERT_EQ(bench.read(HMLFC_REG_STATUS),
              HMLFC_REG_STATUS_READY_MASK | HMLFC_REG_STATUS_IDLE_MASK);
    unsigned during_load = 0;
    for (uint64_t clocks = 0; clocks < 600; clocks += 23) {
      bench.write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
      bench.run_clocks(clocks);
      during_load += (bench.read(HMLFC_REG_STATUS) & HMLFC_REG_STATUS_LOADING_MASK) != 0;
      bench.write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_DISABLE_MASK);
      EXPECT_EQ(status_after_load(bench), HMLFC_REG_STATUS_IDLE_MASK)
          << clocks << " clocks after LOAD";
      bench.write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK | HMLFC_REG_CONTROL_DISABLE_MASK);
      EXPECT_EQ(status_after_load(bench), HMLFC_REG_STATUS_READY_MASK | HMLFC_REG_STATUS_IDLE_MASK)
          << "LOAD has the last word";
    }
    EXPECT_GE(during_load, 10u);
  });
}

// Addresses have 40 bits: the upper ones of a base read 0, and those below are all used.
TEST(Registers, BasesHaveFortyBits) {
  for_each_unit([](Bench& bench, StreamImage& image) {
    for (uint32_t word = 0; word < 6; ++word) {
      bench.write(HMLFC_REG_STREAM_BASE + 4 * word, ~uint32_t{0});
    }
    EXPECT_EQ(bench.read_pair(HMLFC_REG_STREAM_BASE), (uint64_t{1} << 40) - 1);
    EXPECT_EQ(bench.read_pair(HMLFC_REG_STREAM_BYTES), ~uint64_t{0});
    EXPECT_EQ(bench.read_pair(HMLFC_REG_REFERENCE_BASE), (uint64_t{1} << 40) - 1);
    MemoryImage memory = image.memory();
    memory.stream_base = 0xFE'DCBA'9860;
    bench.set_image(memory);
    EXPECT_EQ(bench.load(), HMLFC_REG_STATUS_READY_MASK | HMLFC_REG_STATUS_IDLE_MASK);
    bench.run(mixed_requests(image.golden()->geometry(), image.golden()->header(), 40, 1, 0),
              image.oracle(), {}, 1);
  });
}

// An idle unit needs no clock, one that is spoken to does; after every other reset the bench gives
// it each edge.
TEST(Registers, ClockStopsWhileIdle) {
  for_each_unit([](Bench& bench, StreamImage&) {
    const auto stopped_in = [&](uint64_t clocks) {
      const uint64_t before = bench.unit().stopped_clocks();
      bench.run_clocks(clocks);
      return bench.unit().stopped_clocks() - before;
    };
    EXPECT_GE(stopped_in(1000), 999u);
    const uint64_t before = bench.unit().stopped_clocks();
    const uint64_t begin = bench.cycle();
    EXPECT_EQ(bench.read(HMLFC_REG_ID), HMLFC_REG_ID_RESET);
    EXPECT_LE(bench.unit().stopped_clocks() - before + 2, bench.cycle() - begin);
    bench.reset();
    EXPECT_EQ(stopped_in(1000), 0u);
    bench.reset();
    EXPECT_GE(stopped_in(1000), 999u);
  });
}

// A reset of the unit alone with reads in flight: the late beats show in STATUS until a reset with
// the memory.
TEST(Registers, LateBeatsAfterResetAreReported) {
  for_each_unit([](Bench& bench, StreamImage& image) {
    image.load_into(bench);
    bench.memory().start({.latency = 60}, 1);
    bench.write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
    bench.run_clocks(20);
    EXPECT_EQ(bench.read(HMLFC_REG_STATUS), HMLFC_REG_STATUS_LOADING_MASK) << "not idle: it reads";
    bench.memory().keep_bursts_in_reset(true);
    bench.reset(2);
    EXPECT_EQ(bench.read(HMLFC_REG_STATUS), HMLFC_REG_STATUS_IDLE_MASK);
    bench.run_clocks(200);
    EXPECT_EQ(bench.read(HMLFC_REG_STATUS),
              HMLFC_REG_STATUS_IDLE_MASK | HMLFC_REG_STATUS_STRAY_MASK);
    bench.memory().keep_bursts_in_reset(false);
    bench.reset(2);
    EXPECT_EQ(bench.read(HMLFC_REG_STATUS), HMLFC_REG_STATUS_IDLE_MASK);
    bench.memory().start({}, 1);
    image.load_into(bench);
  });
}

// After DISABLE, idle says that no beat is to come: a reset of the unit alone does no harm.
TEST(Registers, IdleUnitMayBeResetAlone) {
  for_each_unit([](Bench& bench, StreamImage& image) {
    const auto requests = [&](uint64_t count, uint64_t seed) {
      return mixed_requests(image.golden()->geometry(), image.golden()->header(), count, seed, 50);
    };
    bench.memory().keep_bursts_in_reset(true);
    for (uint64_t seed = 0; seed < 8; ++seed) {
      image.load_into(bench);
      bench.run(requests(400, seed), image.oracle(), {.latency = 90}, seed, 300 + 40 * seed);
      bench.write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_DISABLE_MASK);
      while (bench.read(HMLFC_REG_STATUS) != HMLFC_REG_STATUS_IDLE_MASK &&
             !bench.findings().first()) {
      }
      bench.reset(1);
      bench.run_clocks(200);
      ASSERT_EQ(bench.read(HMLFC_REG_STATUS), HMLFC_REG_STATUS_IDLE_MASK)
          << "no late beat, seed " << seed;
      image.load_into(bench);
      bench.run(requests(20, seed), image.oracle(), {}, seed);
      ASSERT_FALSE(bench.findings().first());
    }
    bench.memory().keep_bursts_in_reset(false);
  });
}

}  // namespace
}  // namespace hmlfc::tb
