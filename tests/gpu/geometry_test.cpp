// Frames with geometry of scenes in depth against those of the golden renderer, and faults in what
// they do that this finds. Random streams, which tell little of depth, are in render_test.cpp.
#include "gpu/frame_cases.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

// Kernels with a fault each, as SPIR-V (tests/gpu/CMakeLists.txt).
constexpr uint32_t kAboveHalf[] =
#include "faults/above_half.inc"
    ;
constexpr uint32_t kHalfAgrees[] =
#include "faults/half_agrees.inc"
    ;
constexpr uint32_t kTakesFine[] =
#include "faults/takes_fine.inc"
    ;
constexpr uint32_t kOneStep[] =
#include "faults/one_step.inc"
    ;
constexpr uint32_t kCountsAgain[] =
#include "faults/counts_again.inc"
    ;
constexpr uint32_t kNeverForgets[] =
#include "faults/never_forgets.inc"
    ;
constexpr uint32_t kFirstCell[] =
#include "faults/first_cell.inc"
    ;
constexpr uint32_t kPastTheFrame[] =
#include "faults/past_the_frame.inc"
    ;
constexpr uint32_t kNotBeside[] =
#include "faults/not_beside.inc"
    ;
constexpr uint32_t kOneWindow[] =
#include "faults/one_window.inc"
    ;
constexpr uint32_t kNotBelow[] =
#include "faults/not_below.inc"
    ;

constexpr uint64_t kCacheOfAll = uint64_t{1} << 24;

class GpuGeometry : public GpuTest {};

TEST_F(GpuGeometry, EqualsTheGoldenRenderer) {
  FrameTally tally;
  for (const uint64_t cache_bytes : {uint64_t{0}, uint64_t{16384}, kCacheOfAll}) {
    EXPECT_EQ(difference_of_scenes(device(), 4, tb::Damage::kNone, cache_bytes, tally), "");
  }
  EXPECT_EQ(tally.failed, 0u);
  EXPECT_GT(tally.displaced, 100u);
}

TEST_F(GpuGeometry, TakesBlocksWithAnErrorAsOnesThatTellNothing) {
  FrameTally tally;
  EXPECT_EQ(difference_of_scenes(device(), 24, tb::Damage::kIndexAndTiles, kCacheOfAll, tally), "");
  EXPECT_GT(tally.failed, 20u);
  EXPECT_GT(tally.displaced, 20u);
}

TEST_F(GpuGeometry, KeepsItsBounds) {
  DeviceOptions options;
  options.guard_pages = true;
  options.chunk_bytes = 1024;
  auto device = open(options);
  ASSERT_TRUE(device);
  FrameTally tally;
  EXPECT_EQ(difference_of_scenes(*device, 2, tb::Damage::kNone, 16384, tally), "");
  EXPECT_GT(tally.displaced, 10u);
}

TEST_F(GpuGeometry, ChecksFindPlantedFaults) {
  struct Fault {
    const char* name;
    const char* kernel;
    std::span<const uint32_t> code;
    const char* found;
  };
  const Fault faults[] = {
      {"above half", "surface", kAboveHalf, ""},
      {"half agrees", "surface", kHalfAgrees, ""},
      {"takes fine", "surface", kTakesFine, ""},
      {"one step", "surface", kOneStep, ""},
      {"counts again", "surface", kCountsAgain, "disparities looked up: "},
      {"never forgets", "compact", kNeverForgets, "disparities looked up: "},
      {"first cell", "render", kFirstCell, ": sample "},
      {"past the frame", "surface", kPastTheFrame, ""},
      {"not beside", "render", kNotBeside, ": sample "},
      {"one window", "render", kOneWindow, ": sample "},
      {"not below", "mark", kNotBelow, ""},
  };
  for (const Fault& fault : faults) {
    DeviceOptions options;
    options.kernels[fault.kernel] = {fault.code.begin(), fault.code.end()};
    auto device = Device::open(options);
    ASSERT_TRUE(device);
    FrameTally tally;
    const std::string found =
        difference_of_scenes(*device, 4, tb::Damage::kNone, kCacheOfAll, tally);
    EXPECT_NE(found, "") << fault.name;
    EXPECT_NE(found.find(fault.found), std::string::npos) << fault.name << ": " << found;
  }
}

}  // namespace
}  // namespace hmlfc::gpu
