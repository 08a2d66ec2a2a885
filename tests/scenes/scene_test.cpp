// The five scenes: the same in every run, within range, and with the parallax they promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace hmlfc::scenes {
namespace {

constexpr std::array<Scene, 5> kScenes = {Scene::kCards, Scene::kKnights, Scene::kGlass,
                                          Scene::kFlat, Scene::kNoise};

std::string name_of(const testing::TestParamInfo<Scene>& info) {
  static const std::map<Scene, std::string> names = {{Scene::kCards, "cards"},
                                                     {Scene::kKnights, "knights"},
                                                     {Scene::kGlass, "glass"},
                                                     {Scene::kFlat, "flat"},
                                                     {Scene::kNoise, "noise"}};
  return names.at(info.param);
}

SceneParams params_of(Scene scene, uint32_t rows, uint32_t cols, uint32_t width, uint32_t height) {
  SceneParams params;
  params.scene = scene;
  params.rows = rows;
  params.cols = cols;
  params.width = width;
  params.height = height;
  return params;
}

std::vector<uint16_t> all_samples(const LightField& field) {
  std::vector<uint16_t> samples;
  for (uint32_t row = 0; row < field.shape().rows; ++row) {
    for (uint32_t col = 0; col < field.shape().cols; ++col) {
      const RgbImage view = field.view(row, col);
      samples.insert(samples.end(), view.samples.begin(), view.samples.end());
    }
  }
  return samples;
}

class EveryScene : public testing::TestWithParam<Scene> {};

TEST_P(EveryScene, IsTheSameForAnyNumberOfThreads) {
  const SceneParams params = params_of(GetParam(), 3, 4, 50, 37);
  const auto expected = all_samples(render_scene(params, 1));
  for (const unsigned threads : {0u, 2u, 7u}) {
    EXPECT_EQ(all_samples(render_scene(params, threads)), expected) << threads << " threads";
  }
}

TEST_P(EveryScene, BearsExtremeShapesAndBaselines) {
  for (SceneParams params :
       {params_of(GetParam(), 1, 1, 1, 1), params_of(GetParam(), 1, 101, 3, 2),
        params_of(GetParam(), 40, 2, 16, 5), params_of(GetParam(), 2, 2, 1, 40)}) {
    for (const double baseline : {0.0, 2.0, 64.0}) {
      params.baseline_px = baseline;
      EXPECT_EQ(render_scene(params, 2).shape().cols, params.cols);
    }
  }
}

TEST_P(EveryScene, VariesWithTheSeedUnlessFlat) {
  SceneParams params = params_of(GetParam(), 1, 1, 64, 48);
  const auto first = all_samples(render_scene(params, 2));
  params.seed = 2;
  EXPECT_EQ(all_samples(render_scene(params, 2)) == first, GetParam() == Scene::kFlat);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(kScenes), name_of);

/// A rectangle of whole pixels.
struct Block {
  int left;
  int top;
  int side;
};

/// Sum of absolute differences of a block of `a` and the block of `b` that is shifted by (dx, dy).
int64_t block_difference(const RgbImage& a, const RgbImage& b, const Block& block, int dx, int dy) {
  int64_t sum = 0;
  const auto at = [](const RgbImage& image, int x, int y, int channel) {
    return int{
        image.samples[static_cast<size_t>((y * static_cast<int>(image.width) + x) * 3 + channel)]};
  };
  for (int y = block.top; y < block.top + block.side; ++y) {
    for (int x = block.left; x < block.left + block.side; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        sum += std::abs(at(a, x, y, channel) - at(b, x + dx, y + dy, channel));
      }
    }
  }
  return sum;
}

struct Motion {
  int dx;
  int dy;
  double error;  ///< mean absolute difference of a sample
};

/// The whole-pixel motion of a block from `a` to `b` with the least difference.
Motion find_motion(const RgbImage& a, const RgbImage& b, const Block& block) {
  constexpr int kWindow = 12;
  Motion best{0, 0, 0};
  int64_t least = std::numeric_limits<int64_t>::max();
  for (int dy = -kWindow; dy <= kWindow; ++dy) {
    for (int dx = -kWindow; dx <= kWindow; ++dx) {
      const int64_t difference = block_difference(a, b, block, dx, dy);
      if (difference < least) {
        least = difference;
        best = {dx, dy, static_cast<double>(difference) / (3.0 * block.side * block.side)};
      }
    }
  }
  return best;
}

// The front card of the fan in scene "cards" stands 4.96 world units away (depth 0.992) right of
// the middle below, the cloth at the upper middle about 15 to 16 units (depth near 3.1), the focal
// plane at depth 2.
TEST(Cards, BlocksMoveByTheirDisparity) {
  SceneParams params = params_of(Scene::kCards, 5, 5, 512, 512);
  params.baseline_px = 2.0;
  const LightField field = render_scene(params, 2);
  const Block near_card{330, 395, 40};
  const double near_step = 2.0 * (1.0 / 0.992 - 0.5);  // 1.016 pixels a view
  for (int step = 1; step < 5; ++step) {
    const auto index = static_cast<uint32_t>(step);
    const Motion across = find_motion(field.view(0, 0), field.view(0, index), near_card);
    EXPECT_NEAR(across.dx, -near_step * step, 0.6);
    EXPECT_EQ(across.dy, 0);
    EXPECT_LT(across.error, 8.0);
    const Motion down = find_motion(field.view(0, 0), field.view(index, 0), near_card);
    EXPECT_NEAR(down.dy, -near_step * step, 0.6);
    EXPECT_EQ(down.dx, 0);
    EXPECT_LT(down.error, 8.0);
  }
}

/// Share of pixels whose samples all equal those of view (0, 0).
double equal_share(const LightField& field, uint32_t row, uint32_t col) {
  const RgbImage a = field.view(0, 0);
  const RgbImage b = field.view(row, col);
  size_t equal = 0;
  for (size_t i = 0; i < a.samples.size(); i += 3) {
    if (std::equal(a.samples.begin() + static_cast<ptrdiff_t>(i),
                   a.samples.begin() + static_cast<ptrdiff_t>(i) + 3,
                   b.samples.begin() + static_cast<ptrdiff_t>(i))) {
      ++equal;
    }
  }
  return 3.0 * static_cast<double>(equal) / static_cast<double>(a.samples.size());
}

TEST(Flat, AlmostAllPixelsAreEqualInAllViews) {
  const LightField field = render_scene(params_of(Scene::kFlat, 8, 8, 256, 192), 2);
  for (uint32_t row = 0; row < 8; ++row) {
    for (uint32_t col = 0; col < 8; ++col) EXPECT_GE(equal_share(field, row, col), 0.99);
  }
  EXPECT_LT(equal_share(field, 7, 7), 1.0) << "the disc does not move";
}

}  // namespace
}  // namespace hmlfc::scenes
