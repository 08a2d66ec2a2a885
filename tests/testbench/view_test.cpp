// The view unit against the golden model; the DMA alone, with the model as its decode unit, in
// every block size.
#include <gtest/gtest.h>

#include <iostream>

#include "testbench/view_scenarios.hpp"

namespace hmlfc::tb {
namespace {

// Streams by seed, of both profiles; odd seeds from 3 on with blocks that do not decode.
std::vector<uint8_t> stream(uint32_t seed, unsigned block_size) {
  auto bytes = suite_stream(seed, block_size);
  if (seed % 4 == 3) corrupt(bytes, Damage::kTiles, seed);
  return bytes;
}

// Pixels of 12 bits, of which each block has one component with one bit of 8 to 11, at each place
// in turn.
std::vector<uint8_t> pictures_of_one_bit(unsigned b) {
  constexpr uint32_t kBlocks = 24;  // a row
  LightField field({1, 1, kBlocks * b, b * b * b, 12});
  for (uint32_t y = 0; y < b * b * b; ++y) {
    std::vector<uint16_t> row(size_t{3} * kBlocks * b, 7);
    for (uint32_t i = 0; i < kBlocks; ++i) {
      const uint32_t place = y / b;  // as many as a block has
      const uint32_t x = i * b + place % b;
      if (place / b == y % b) row[3 * x + i % 3] = static_cast<uint16_t>(1u << (8 + i / 3 % 4));
    }
    field.write_row(0, 0, y, row);
  }
  EncodeParams params;
  params.profile = Profile::kMain;
  params.block_size = b;
  params.lossless = true;
  return encode(field, params)->bytes;
}

class ViewDma : public testing::TestWithParam<uint32_t> {};

TEST_P(ViewDma, EqualsTheModel) {
  for (const UnitMaker& maker : view_dmas()) {
    const auto bytes = stream(GetParam(), maker.parameters.block_size());
    ViewRun run(bytes, maker, GetParam());
    run.everything();
    ASSERT_EQ(run.finding(), "") << "B " << maker.parameters.block_size();
  }
}

INSTANTIATE_TEST_SUITE_P(Seed, ViewDma, testing::Range(0U, 8U));

TEST(ViewDma, ReachesEveryMacroRow) {
  for (const UnitMaker& maker : view_dmas()) {
    const auto bytes = large_picture(maker.parameters.block_size());
    ViewRun run(bytes, maker, 1);
    run.whole_views();
    run.rectangles(12);
    ASSERT_EQ(run.finding(), "") << "B " << maker.parameters.block_size();
  }
}

TEST(ViewDma, ReachesTheLastColumn) {
  const auto bytes = wide_picture();
  ViewRun run(bytes, view_dmas().front(), 1);
  run.whole_view(ViewFormat::kRgb161616);
  run.whole_view(ViewFormat::kCg);
  ASSERT_EQ(run.finding(), "");
}

TEST(ViewDma, CountsBlocksThatDoNotDecodeOrFit) {
  for (const UnitMaker& maker : view_dmas()) {
    const unsigned b = maker.parameters.block_size();
    const auto bytes = pictures_of_one_bit(b);
    ViewRun run(bytes, maker, 1);
    const auto errors_of = [&](ViewFormat format) {
      run.whole_view(format);
      EXPECT_EQ(run.finding(), "");
      return run.bench().last_status();
    };
    EXPECT_EQ(errors_of(ViewFormat::kRgb888).first_error, 24);  // limit_exceeded
    EXPECT_EQ(errors_of(ViewFormat::kRgb101010).block_errors, 12 * b * b);
    EXPECT_EQ(errors_of(ViewFormat::kRgb161616).first_error, 0);
    run.rectangles(40);  // that end within blocks
    ASSERT_EQ(run.finding(), "") << "B " << b;
  }
}

TEST(ViewUnit, EqualsTheModel) {
  for (const UnitMaker& maker : view_units()) {
    for (const uint32_t seed : {0u, 1u, 3u}) {
      const auto bytes = stream(seed, maker.parameters.block_size());
      ViewRun run(bytes, maker, seed);
      run.everything();
      run.loads();
      ASSERT_EQ(run.finding(), "") << "B " << maker.parameters.block_size() << ", seed " << seed;
    }
  }
}

// After the first reset and before the second the clock stands still where nothing is to do.
TEST(ViewUnit, ClockStopsWhileIdle) {
  const auto bytes = stream(0, 4);
  ViewRun run(bytes, view_units().front(), 0);
  run.rectangles(2);
  const uint64_t before = run.bench().host().stopped_clocks();
  run.bench().host().idle(1000);
  EXPECT_GE(run.bench().host().stopped_clocks() - before, 990u);
  run.bench().host().open(true);
  run.bench().host().load();
  const uint64_t after = run.bench().host().stopped_clocks();
  run.rectangles(2);
  run.bench().host().idle(1000);
  EXPECT_EQ(run.bench().host().stopped_clocks(), after);
  EXPECT_EQ(run.finding(), "");
}

// The rate of descriptors of one block whose tiles and strips are held.
TEST(ViewUnit, TakesDescriptorsBackToBack) {
  constexpr unsigned kCount = 64;
  const UnitMaker maker = view_units().front();
  const auto bytes = stream(0, maker.parameters.block_size());
  StreamImage image(bytes, maker.parameters);
  ViewBench bench(maker.make(maker.parameters, nullptr), bytes, image.area().bytes, image.oracle(),
                  kCount);
  std::vector<Descriptor> all(kCount, Descriptor{.width = 4, .height = 4});
  for (Descriptor& d : all) bench.host().allocate(d, 0, true);
  bench.host().memory().start({}, 1);
  bench.run_drained(all);
  const uint64_t begin = bench.host().clocks();
  bench.run_drained(all);
  const auto clocks = static_cast<double>(bench.host().clocks() - begin);
  EXPECT_EQ(bench.finding(), "");
  std::cout << clocks / kCount << " clocks a descriptor\n";
  EXPECT_LE(clocks / kCount, 60);
}

}  // namespace
}  // namespace hmlfc::tb
