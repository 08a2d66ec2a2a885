// Workgroups in another order, and invocations with other numbers in their workgroup: the same
// samples and frames.
#include <algorithm>

#include "gpu/frame_cases.hpp"
#include "gpu/gpu_test.hpp"
#include "gpu/render_pair.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

// Every kernel in the order kDefaultOrder (shuffled_kernels.py).
KernelCode shuffled_kernels() {
  return {
#include "shuffled/kernels.inc"
  };
}

constexpr uint32_t kDefaultOrder = 0x5EED5EED;
constexpr uint32_t kOrders[] = {
    0x1,        // backwards
    0x12302,    // every 31st, from one in the middle on
    0xFC,       // the last invocation of a workgroup is the first
    0x7654357,  // all three
};

class GpuShuffledOrder : public GpuTest, public testing::WithParamInterface<uint32_t> {
 protected:
  static std::optional<Device> open_in_order(uint32_t order) {
    DeviceOptions options;
    options.kernels = shuffled_kernels();
    for (auto& [name, words] : options.kernels) {
      EXPECT_EQ(std::ranges::count(words, kDefaultOrder), 1) << name;
      std::ranges::replace(words, kDefaultOrder, order);
    }
    return open(std::move(options));
  }

  static std::string difference_of_walks(Device& device) {
    FrameTally tally;
    for (uint32_t seed = 0; seed < 6; ++seed) {
      auto bytes = test::random_stream(seed);
      if (seed % 3 == 2) tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
      RenderPair pair(device, std::move(bytes), uint64_t{1} << 14);
      if (pair.closed()) continue;
      if (auto found = difference_of_walk(pair, seed, 6, tally); !found.empty()) return found;
    }
    EXPECT_GT(tally.lit, 10u);
    return {};
  }
};

TEST_P(GpuShuffledOrder, GivesTheSameBlocks) {
  auto shuffled = open_in_order(GetParam());
  ASSERT_TRUE(shuffled);
  for (uint32_t seed = 0; seed < 4; ++seed) {
    expect_equal(*shuffled, test::random_stream(seed), {.requests = 200, .seed = seed});
  }
}

TEST_P(GpuShuffledOrder, GivesTheSameFrames) {
  auto shuffled = open_in_order(GetParam());
  ASSERT_TRUE(shuffled);
  EXPECT_EQ(difference_of_walks(*shuffled), "");
  FrameTally tally;
  EXPECT_EQ(difference_of_scenes(*shuffled, 2, tb::Damage::kNone, uint64_t{1} << 14, tally), "");
  EXPECT_GT(tally.displaced, 0u);
}

INSTANTIATE_TEST_SUITE_P(Orders, GpuShuffledOrder, testing::ValuesIn(kOrders));

}  // namespace
}  // namespace hmlfc::gpu
