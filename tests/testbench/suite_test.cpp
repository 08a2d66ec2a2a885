// The regression against the stand-in: the sequences themselves reach what they are for.
#include "systemc/suite.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "stimulus/sequences.hpp"
#include "testbench/test_bench.hpp"
#include "unit/stand_in.hpp"

namespace hmlfc::tb {
namespace {

TEST(Suite, PassesOnTheStandInAndCoversEveryPoint) {
  Bench& bench = test_bench();
  std::vector<uint32_t> seeds(88);
  std::iota(seeds.begin(), seeds.end(), 0u);
  // The next ones that reach a cross which those before do not.
  for (const uint32_t seed : {90u, 91u, 92u, 108u, 114u, 117u, 146u, 155u, 216u, 360u, 384u}) {
    seeds.push_back(seed);
  }
  for (uint32_t seed = 94; seed < 240; seed += 3) seeds.push_back(seed);  // blocks of 4
  for (const uint32_t seed : seeds) {
    auto bytes = seed == 0 ? main_stream(1, 1) : suite_stream(seed, 2u << seed % 3);
    const UnitMaker maker{"stand-in",
                          {bytes[30], 12, seed % 5 == 0 ? 8u : 16u, 16},  // block_log2
                          &StandIn::make};
    corrupt(bytes, suite_damage(seed), seed);
    StreamImage image(bytes, maker.parameters);
    const SuiteResult result = run_case(bench, maker, image, seed);
    ASSERT_FALSE(result.mismatch) << "seed " << seed << ": " << to_string(*result.mismatch);
    EXPECT_EQ(result.counts.sent, result.counts.received + result.counts.dropped);
    EXPECT_EQ(result.counts.received, result.counts.compared + result.counts.unchecked);
  }
  for (const std::string& point : bench.coverage().missed()) ADD_FAILURE() << "missed: " << point;
  for (const std::string& cross : bench.coverage().missed_crosses()) {
    ADD_FAILURE() << "missed: " << cross;
  }
}

TEST(ScanOrder, VisitsEachBlockOnceAndQuadsTogether) {
  for (const auto& [columns, rows] : {std::pair{33u, 47u}, {1u, 1u}, {64u, 8u}}) {
    std::vector<int> seen(size_t{columns} * rows, 0);
    uint64_t count = 0;
    auto order = ScanOrder(columns, rows);
    while (const auto block = order.next()) {
      ++seen[block->by * columns + block->bx];
      ++count;
    }
    EXPECT_EQ(count, uint64_t{columns} * rows);
    EXPECT_EQ(std::ranges::count(seen, 1), static_cast<int64_t>(seen.size()));
  }
}

}  // namespace
}  // namespace hmlfc::tb
