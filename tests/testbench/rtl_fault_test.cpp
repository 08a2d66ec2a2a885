// Faults planted in the RTL are found by the regression, each at the stage where it is.
#include "unit/rtl_faults.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "systemc/suite.hpp"
#include "testbench/test_bench.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint32_t kSeeds = 12;  // as many streams as may be needed to meet a fault

unsigned fault_to_make = 0;  // of make_unit, which a UnitMaker has as a function

std::unique_ptr<DecodeUnit> make_unit(const UnitParameters& parameters) {
  return make_faulty_unit(parameters, fault_to_make);
}

// The first finding over `seeds` streams of the regression from `seed` on, which becomes the one
// that had it.
std::optional<Mismatch> run_with(unsigned fault, uint32_t& seed, uint32_t seeds) {
  fault_to_make = fault;
  const UnitMaker maker{"faulty", kFaultyUnit, &make_unit};
  for (const uint32_t end = seed + seeds; seed < end; ++seed) {
    auto bytes = suite_stream(seed, maker.parameters.block_size());
    corrupt(bytes, suite_damage(seed), seed);
    StreamImage image(bytes, maker.parameters);
    const SuiteResult result = run_case(test_bench(), maker, image, seed);
    if (result.mismatch) return result.mismatch;
  }
  return std::nullopt;
}

TEST(RtlWithoutFault, EqualsTheModel) {
  uint32_t seed = 0;
  const auto mismatch = run_with(0, seed, 4);
  EXPECT_FALSE(mismatch) << "seed " << seed << ": " << to_string(*mismatch);
}

[[maybe_unused]] void PrintTo(const RtlFault& fault, std::ostream* out) {
  *out << fault.name << " in " << fault.module;
}

class RtlFaults : public testing::TestWithParam<RtlFault> {};

TEST_P(RtlFaults, IsFoundAtItsStage) {
  uint32_t seed = GetParam().seed;
  const auto mismatch = run_with(GetParam().number, seed, kSeeds);
  ASSERT_TRUE(mismatch) << "not found in " << kSeeds << " streams";
  std::cout << "seed " << seed << ": " << to_string(*mismatch) << "\n";
  EXPECT_EQ(mismatch->rule.substr(0, GetParam().rule.size()), GetParam().rule)
      << to_string(*mismatch);
}

INSTANTIATE_TEST_SUITE_P(Rtl, RtlFaults, testing::ValuesIn(rtl_faults()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace hmlfc::tb
