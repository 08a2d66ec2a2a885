// Frames with geometry of scenes in depth against those of the golden renderer, and faults in what
// they do that this finds. Random streams, which tell little of depth, are in render_test.cpp.
#include <hmlfc/encoder.hpp>

#include "gpu/gpu_test.hpp"
#include "gpu/render_pair.hpp"
#include "scenes/scene.hpp"
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

/// A scene in depth; of either profile, by `seed`.
std::vector<uint8_t> scene_stream(uint32_t seed) {
  scenes::SceneParams params;
  params.scene = seed % 4 < 2 ? scenes::Scene::kKnights : scenes::Scene::kCards;
  params.rows = 3;
  params.cols = 4;
  params.width = 72;
  params.height = 56;
  params.baseline_px = 6;
  EncodeParams coding;
  coding.profile = seed % 2 == 0 ? Profile::kExtended : Profile::kMain;
  coding.threads = 1;
  return encode(scenes::render_scene(params, 1), coding)->bytes;
}

/// A camera near the views, with a focal plane somewhere about the scene. Some of its frames are as
/// coarse as far cells, others so fine that a window holds few pixels.
Camera geometry_camera(test::Random& random, const StreamHeader& header) {
  Camera camera = test::random_camera(random, header);
  const auto between = [&](double lo, double hi) {
    return lo + (hi - lo) * random() / 4294967296.0;
  };
  camera.geometry = GeometrySource::kStream;
  camera.aperture = 0;
  camera.shear = 0;
  camera.look_at.reset();
  camera.row_pitch = random() % 3 == 0 ? -1 : 1;
  camera.position->z = random() % 2 == 0 ? 0 : between(-1, 1);
  camera.focus = between(-4, 4);
  camera.tan_half.reset();
  if (random() % 2 == 0) {  // with the pixels of views
    camera.frame_width.reset();
    camera.frame_height.reset();
  }
  return camera;
}

/// Frames before the streams of `seeds` seeds; the first difference, or nothing.
std::string difference_of_frames(Device& device, uint32_t seeds, tb::Damage damage,
                                 uint64_t cache_bytes, FrameTally& tally) {
  for (uint32_t seed = 0; seed < seeds; ++seed) {
    auto bytes = scene_stream(seed);
    tb::corrupt(bytes, damage, seed);
    RenderPair pair(device, std::move(bytes), cache_bytes);
    if (pair.closed()) continue;
    test::Random random(seed);
    for (int i = 0; i < 12; ++i) {
      const auto record = frame_record(geometry_camera(random, pair.header()), pair.header());
      if (!record) continue;
      const std::string found = pair.difference(*record, 0, tally);
      if (!found.empty()) {
        return "seed " + std::to_string(seed) + ", frame " + std::to_string(i) + ": " + found;
      }
    }
  }
  return {};
}

TEST_F(GpuGeometry, EqualsTheGoldenRenderer) {
  FrameTally tally;
  for (const uint64_t cache_bytes : {uint64_t{0}, uint64_t{16384}, kCacheOfAll}) {
    EXPECT_EQ(difference_of_frames(device(), 4, tb::Damage::kNone, cache_bytes, tally), "");
  }
  EXPECT_EQ(tally.failed, 0u);
  EXPECT_GT(tally.displaced, 100u);
}

TEST_F(GpuGeometry, TakesBlocksWithAnErrorAsOnesThatTellNothing) {
  FrameTally tally;
  EXPECT_EQ(difference_of_frames(device(), 24, tb::Damage::kIndexAndTiles, kCacheOfAll, tally), "");
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
  EXPECT_EQ(difference_of_frames(*device, 2, tb::Damage::kNone, 16384, tally), "");
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
        difference_of_frames(*device, 4, tb::Damage::kNone, kCacheOfAll, tally);
    EXPECT_NE(found, "") << fault.name;
    EXPECT_NE(found.find(fault.found), std::string::npos) << fault.name << ": " << found;
  }
}

}  // namespace
}  // namespace hmlfc::gpu
