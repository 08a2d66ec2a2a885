// The regression against every Verilated unit of this build.
#include <gtest/gtest.h>

#include "systemc/suite.hpp"
#include "testbench/test_bench.hpp"

namespace hmlfc::tb {
namespace {

// Seeds, every other one with a damaged stream; ./run soak goes on with others. A test each, so
// that they run at the same time.
#ifndef HMLFC_RTL_SEEDS
#define HMLFC_RTL_SEEDS 2
#endif
class Rtl : public testing::TestWithParam<uint32_t> {};

void expect_equal(const UnitMaker& maker, uint32_t seed) {
  auto bytes = suite_stream(seed, maker.parameters.block_size());
  corrupt(bytes, suite_damage(seed), seed);
  StreamImage image(bytes, maker.parameters);
  const SuiteResult result = run_case(test_bench(), maker, image, seed);
  ASSERT_FALSE(result.mismatch) << "replay: ./run rtl-random --seed " << seed << ": B "
                                << maker.parameters.block_size() << ", depth to "
                                << maker.parameters.max_depth << ", seed " << seed << ": "
                                << to_string(*result.mismatch);
}

TEST_P(Rtl, EqualsTheModelOnRandomStreams) {
  const auto makers = rtl_units();
  if (makers.empty()) GTEST_SKIP() << "SKIP_NO_RTL: Verilator or the top module is missing";
  for (const UnitMaker& maker : makers) {
    expect_equal(maker, GetParam());
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Seed, Rtl, testing::Range(0U, HMLFC_RTL_SEEDS + 0U));

}  // namespace
}  // namespace hmlfc::tb
