// Every synthetic scene in both profiles: every block of every view, in RGB, at all stages.
#include <hmlfc/encoder.hpp>

#include "decoder/open_stream.hpp"
#include "gpu/gpu_test.hpp"
#include "scenes/scene.hpp"

namespace hmlfc::gpu {
namespace {

class GpuScenes : public GpuTest, public testing::WithParamInterface<scenes::Scene> {};

void check_every_block(Device& device, const std::vector<uint8_t>& bytes) {
  const auto view = open_stream(bytes, {});
  ASSERT_TRUE(view);
  auto decoder = GpuDecoder::open(device, *view);
  ASSERT_TRUE(decoder) << decoder.error().message;
  tb::ScanPlan plan;
  plan.views = 100;
  const PlaneShape& blocks = view->geometry.plane(Plane::kY);
  EXPECT_EQ(expect_scan_equal(*decoder, bytes, plan).compared,
            uint64_t{view->header.rows} * view->header.cols * blocks.blocks_x * blocks.blocks_y);
}

TEST_P(GpuScenes, AreEqualInBothProfiles) {
  scenes::SceneParams params;
  params.scene = GetParam();
  params.rows = 5;
  params.cols = 4;
  params.width = 101;
  params.height = 67;
  params.depth = 10;
  const LightField field = scenes::render_scene(params, 1);
  for (const Profile profile : {Profile::kMain, Profile::kExtended}) {
    for (const ChromaFormat chroma : {ChromaFormat::k420, ChromaFormat::k444}) {
      EncodeParams coding;
      coding.profile = profile;
      coding.window = 16;
      coding.ref_rows = coding.ref_cols = 8;
      coding.chroma = chroma;
      coding.tree_height = chroma == ChromaFormat::k420 ? 2 : 1;
      const auto encoded = encode(field, coding);
      ASSERT_TRUE(encoded) << encoded.error().message;
      check_every_block(device(), encoded->bytes);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, GpuScenes,
                         testing::Values(scenes::Scene::kCards, scenes::Scene::kKnights,
                                         scenes::Scene::kGlass, scenes::Scene::kFlat,
                                         scenes::Scene::kNoise));

}  // namespace
}  // namespace hmlfc::gpu
