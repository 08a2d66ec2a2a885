// The regression against every Verilated unit of this build.
#include <gtest/gtest.h>

#include "systemc/suite.hpp"
#include "testbench/test_bench.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint32_t kSeeds = 2;  // of each test; ./run soak goes on

// Seeds from the parameter on. Several tests, so that they run beside each other.
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
    for (uint32_t i = 0; i < kSeeds; ++i) {
      expect_equal(maker, GetParam() + i);
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(From, Rtl, testing::Values(0, 2, 4, 6));

}  // namespace
}  // namespace hmlfc::tb
