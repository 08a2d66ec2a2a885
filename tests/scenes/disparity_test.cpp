// The disparities of scenes: pictures move by them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <vector>

#include "scenes/scene.hpp"

namespace hmlfc::scenes {
namespace {

SceneParams params_of(Scene scene) {
  SceneParams params;
  params.scene = scene;
  params.rows = 2;
  params.cols = 2;
  params.width = 160;
  params.height = 120;
  params.baseline_px = 8;
  return params;
}

using Maps = std::map<uint32_t, std::vector<float>>;  // by 2 * row + col

Maps maps_of(const SceneParams& params) {
  Maps maps;
  std::mutex mutex;
  const auto keep = [&](uint32_t row, uint32_t col, std::span<const float> pixels) {
    const std::scoped_lock lock(mutex);
    maps[2 * row + col].assign(pixels.begin(), pixels.end());
  };
  EXPECT_TRUE(render_disparities(params, 2, {}, keep));
  return maps;
}

// The share of pixels for which `holds(x, y, x', y')` at the pixel to which they move from view
// (0, 0) to view (row, col), of those that stay in the picture.
template <class Holds>
double share(const SceneParams& params, const std::vector<float>& map, int row, int col,
             const Holds& holds) {
  int inside = 0;
  int held = 0;
  for (int y = 0; y < static_cast<int>(params.height); ++y) {
    for (int x = 0; x < static_cast<int>(params.width); ++x) {
      const float d = map[static_cast<size_t>(y) * params.width + static_cast<size_t>(x)];
      const long to_x = std::lround(x + double{d} * col);
      const long to_y = std::lround(y + double{d} * row);
      if (to_x < 0 || to_x >= params.width || to_y < 0 || to_y >= params.height) continue;
      ++inside;
      held += holds(x, y, to_x, to_y) ? 1 : 0;
    }
  }
  return static_cast<double>(held) / inside;
}

TEST(SceneDisparities, LeadToTheSameSurfaceInOtherViews) {
  for (const Scene scene : {Scene::kCards, Scene::kKnights, Scene::kGlass, Scene::kFlat}) {
    const SceneParams params = params_of(scene);
    const Maps maps = maps_of(params);
    ASSERT_EQ(maps.size(), 4u);
    const auto [least, greatest] = std::minmax_element(maps.at(0).begin(), maps.at(0).end());
    EXPECT_LT(*least, -0.5);
    EXPECT_GT(*greatest, scene == Scene::kFlat ? -0.1 : 0.1);
    for (const int view : {1, 2, 3}) {
      const auto same = [&](int x, int y, long to_x, long to_y) {
        const auto at = [&](uint32_t v, long px, long py) {
          return maps.at(v)[static_cast<size_t>(py) * params.width + static_cast<size_t>(px)];
        };
        return std::abs(at(0, x, y) - at(static_cast<uint32_t>(view), to_x, to_y)) < 0.15;
      };
      EXPECT_GT(share(params, maps.at(0), view / 2, view % 2, same), 0.7)
          << static_cast<int>(scene) << " view " << view;
    }
  }
}

// What does not shine looks the same from the next view, where the disparity says that it is.
TEST(SceneDisparities, LeadToTheSameColour) {
  const SceneParams params = params_of(Scene::kCards);
  const Maps maps = maps_of(params);
  const LightField field = render_scene(params, 2);
  const RgbImage first = field.view(0, 0);
  const RgbImage next = field.view(1, 1);
  const auto at = [&](const RgbImage& view, long px, long py) {
    return static_cast<double>(
        view.samples[(static_cast<size_t>(py) * params.width + static_cast<size_t>(px)) * 3 + 1]);
  };
  const auto mean_error = [&](const std::vector<float>& map) {
    double sum = 0;
    int pixels = 0;
    share(params, map, 1, 1, [&](int x, int y, long to_x, long to_y) {
      const double error = at(first, x, y) - at(next, to_x, to_y);
      sum += error * error;
      ++pixels;
      return true;
    });
    return sum / pixels;
  };
  const std::vector<float> still(maps.at(0).size());
  EXPECT_LT(mean_error(maps.at(0)), 0.5 * mean_error(still));
}

TEST(SceneDisparities, NoiseHasNone) {
  const auto fail = [](uint32_t, uint32_t, std::span<const float>) { FAIL(); };
  EXPECT_FALSE(render_disparities(params_of(Scene::kNoise), 1, {}, fail));
}

}  // namespace
}  // namespace hmlfc::scenes
