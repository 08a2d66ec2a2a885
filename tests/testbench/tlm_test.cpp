// The sequences of the bench against the TLM model.
#include "tlm/tlm_platform.hpp"

#include <gtest/gtest.h>

#include "stimulus/random_stream.hpp"
#include "stimulus/sequences.hpp"
#include "systemc/stream_image.hpp"
#include "systemc/suite.hpp"
#include "testbench/test_bench.hpp"

namespace hmlfc::tb {
namespace {

constexpr UnitParameters kParameters{2, 12, 16, 16};

TlmPlatform& platform() {
  static TlmPlatform made("platform", kParameters);
  return made;
}

void run(const std::vector<uint8_t>& bytes, uint64_t seed) {
  StreamImage image(bytes, kParameters);
  const auto source = image.golden() == nullptr
                          ? listed_requests({{}, {1, 1, 1, 1, kRgb, 0, true}})
                          : with_residuals(mixed_requests(image.golden()->geometry(),
                                                          image.golden()->header(), 300, seed, 50),
                                           seed, 100);
  platform().run(image.memory(), image.load_error(), source, image.oracle());
  const auto& mismatch = platform().findings().first();
  EXPECT_FALSE(mismatch) << "seed " << seed << ": " << to_string(*mismatch);
  const ScoreCounts& counts = platform().scoreboard().counts();
  EXPECT_GT(counts.compared, 0u);
  EXPECT_EQ(counts.sent, counts.received);
  EXPECT_EQ(counts.received, counts.compared);
}

TEST(TlmModel, AnswersAsTheGoldenModel) {
  for (uint32_t seed = 0; seed < 12; ++seed) run(suite_stream(seed, 4), seed);
}

TEST(TlmModel, RefusesWhatLoadMustRefuse) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    auto bytes = suite_stream(seed, 4);
    corrupt(bytes, seed % 2 == 0 ? Damage::kHeaderField : Damage::kCut, seed);
    run(bytes, seed);
  }
  run(suite_stream(3, 8), 3);  // blocks of another size
}

TEST(TlmModel, ReportsDamage) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    auto bytes = suite_stream(seed, 4);
    corrupt(bytes, Damage::kIndexAndTiles, seed);
    run(bytes, seed);
  }
}

}  // namespace
}  // namespace hmlfc::tb
