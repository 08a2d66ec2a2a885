// What holds no information takes next to no bytes.
#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "scenes/scene.hpp"

namespace hmlfc {
namespace {

double bits_per_pixel(uint64_t bytes, const LightFieldShape& shape) {
  const uint64_t pixels = uint64_t{shape.rows} * shape.cols * shape.width * shape.height;
  return 8.0 * static_cast<double>(bytes) / static_cast<double>(pixels);
}

TEST(SparseStream, FlatSceneStaysUnderAHundredthOfABitBesideItsTopLevel) {
  scenes::SceneParams scene;
  scene.scene = scenes::Scene::kFlat;
  scene.rows = 9;
  scene.cols = 9;
  scene.width = 512;
  scene.height = 384;
  const LightField field = scenes::render_scene(scene, 0);
  for (const Method method : {Method::kHmlfc, Method::kRlfc}) {
    EncodeParams params;
    params.profile = Profile::kMain;
    params.method = method;
    const auto encoded = encode(field, params);
    ASSERT_TRUE(encoded.has_value());
    const auto decoder = Decoder::open(encoded->bytes);
    ASSERT_TRUE(decoder.has_value());
    const auto statistics = decoder->statistics();
    ASSERT_TRUE(statistics.has_value());
    EXPECT_EQ(statistics->sections.total(), encoded->bytes.size());
    const uint64_t beside_top = encoded->bytes.size() - statistics->sections.top;
    EXPECT_LT(bits_per_pixel(beside_top, field.shape()), 0.01);
  }
}

}  // namespace
}  // namespace hmlfc
