// The view unit against the golden model; the DMA alone, with the model as its decode unit, in
// every block size.
#include <gtest/gtest.h>

#include "driver/hmlfc_registers.h"
#include "testbench/view_scenarios.hpp"

namespace hmlfc::tb {
namespace {

// Streams by seed, of both profiles; odd seeds from 3 on with blocks that do not decode.
std::vector<uint8_t> stream(uint32_t seed, unsigned block_size) {
  auto bytes = suite_stream(seed, block_size);
  if (seed % 4 == 3) corrupt(bytes, Damage::kTiles, seed);
  return bytes;
}

// 2 x 2 pixels of 12 bits, all 4095.
std::vector<uint8_t> white_picture() {
  LightField white({1, 1, 2, 2, 12});
  white.write_row(0, 0, 0, std::vector<uint16_t>(6, 4095));
  white.write_row(0, 0, 1, std::vector<uint16_t>(6, 4095));
  EncodeParams params;
  params.profile = Profile::kMain;
  params.block_size = 2;
  params.lossless = true;
  return encode(white, params)->bytes;
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

TEST(ViewDma, CountsBlocksThatDoNotDecodeOrFit) {
  const UnitMaker maker = view_dmas().front();
  const std::vector<uint8_t> bytes = white_picture();
  const auto errors_of = [&](ViewFormat format) {
    ViewRun run(bytes, maker, 1);
    Descriptor d{.tag = 1, .format = format, .width = 1, .height = 1};
    run.bench().host().allocate(d, 0, true);
    run.bench().run(std::span(&d, 1));
    EXPECT_EQ(run.finding(), "");
    return run.bench().last_status();
  };
  EXPECT_EQ(errors_of(ViewFormat::kRgb888).first_error, 24);  // limit_exceeded
  EXPECT_EQ(errors_of(ViewFormat::kRgb101010).block_errors, 1u);
  EXPECT_EQ(errors_of(ViewFormat::kRgb161616).first_error, 0);
}

TEST(ViewUnit, EqualsTheModel) {
  for (const UnitMaker& maker : view_units()) {
    for (const uint32_t seed : {0u, 1u, 3u}) {
      const auto bytes = stream(seed, maker.parameters.block_size());
      ViewRun run(bytes, maker, seed);
      run.everything();
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
  run.bench().host().reset();
  const uint64_t after = run.bench().host().stopped_clocks();
  run.rectangles(2);
  run.bench().host().idle(1000);
  EXPECT_EQ(run.bench().host().stopped_clocks(), after);
  EXPECT_EQ(run.finding(), "");
}

// The DMA reads a descriptor while the decode unit reads the header: each takes its own answers.
TEST(ViewUnit, FetchesDescriptorsDuringLoad) {
  for (const UnitMaker& maker : view_units()) {
    const auto bytes = stream(0, maker.parameters.block_size());
    ViewRun run(bytes, maker, 0);
    for (int i = 0; i < 8; ++i) {
      run.bench().host().write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
      run.bench().host().idle(static_cast<uint64_t>(i));
      run.rectangles(1);
    }
    ASSERT_EQ(run.finding(), "") << "B " << maker.parameters.block_size();
  }
}

}  // namespace
}  // namespace hmlfc::tb
