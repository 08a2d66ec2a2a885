// Click to focus (hmlfc/focus.hpp): hand-made maps, and a scene whose disparities are known.
#include <hmlfc/focus.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "render/render_cases.hpp"
#include "scenes/scene.hpp"
#include "support/streams.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc {
namespace {

// A row of six views of 40 x 40 with the same map: strips of whole pixels a column, each begins at
// its x, a multiple of 4.
struct Strip {
  int begin;
  int disparity;
};

test::OpenedStream strips(const std::vector<Strip>& strips) {
  StreamHeader header = test::row_of_views(0);
  header.disparity_grid_log2 = 2;
  header.levels = {{1, 6, 0}};
  test::StreamParts stream(header);
  std::vector<int16_t> grid;
  for (int block = 0; block < 100; ++block) {
    int16_t disparity = 0;
    for (const Strip& strip : strips) {
      if (block % 10 * 4 >= strip.begin) disparity = static_cast<int16_t>(4 * strip.disparity);
    }
    grid.push_back(disparity);
  }
  const ImagePos reference = stream.geometry.reference_of(0, {0, 0});
  stream.motion_tile(0, reference) = write_disparity_tile(grid);
  return test::OpenedStream(stream.file());
}

// Sight, disparity in pixels a column, and column of the view that tells.
void expect_focus(const Decoder& decoder, const Camera& camera, uint32_t x, double focus,
                  uint32_t col) {
  const auto found = focus_at(decoder, camera, x, 20);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_EQ(found->sight, PixelSight::kSurface) << x;
  EXPECT_EQ(found->focus(), focus) << x;
  EXPECT_EQ(found->view.col, col) << x;
}

Camera at_column(double u) {
  Camera camera;
  camera.position = {u, 0, 0};
  return camera;
}

TEST(FocusAt, AtAViewItIsTheDisparityOfThePixel) {
  const auto stream = strips({{0, -6}, {20, 3}});
  expect_focus(*stream.decoder, at_column(4), 19, -6, 4);
  expect_focus(*stream.decoder, at_column(4), 20, 3, 4);
  Camera focused = at_column(4);
  focused.focus = -9;
  expect_focus(*stream.decoder, focused, 20, 3, 4);
}

TEST(FocusAt, BetweenViewsTheRayIsFollowed) {
  // In view 3 the ray of a camera in column 2.5 lies at x + disparity / 2.
  const auto near_left = strips({{0, -6}, {20, -10}});
  expect_focus(*near_left.decoder, at_column(2.5), 26, -10, 3);  // stays at 21
  expect_focus(*near_left.decoder, at_column(2.5), 22, -6, 3);   // 22, 17, 19
  // In view 2, at x - 0.4 * disparity.
  expect_focus(*near_left.decoder, at_column(2.4), 18, -10, 2);  // 18, 20.4, 22
  // 22, 17, 23, 17 ...: the ray passes the edge of what is near.
  const auto near_right = strips({{0, 2}, {20, -10}});
  expect_focus(*near_right.decoder, at_column(2.5), 22, 2, 3);
}

TEST(FocusAt, OneBlockAmongNineDoesNotCount) {
  const auto stream = strips({{0, 1}, {16, 7}, {20, 1}});
  expect_focus(*stream.decoder, at_column(4), 17, 1, 4);
}

TEST(FocusAt, RefusesWhatIsNoPixelOfAFrame) {
  const auto stream = strips({{0, 1}});
  Camera camera = at_column(4);
  camera.frame_width = 30;
  expect_focus(*stream.decoder, camera, 29, 1, 4);
  const auto refused = [&](uint32_t x, uint32_t y) {
    const auto found = focus_at(*stream.decoder, camera, x, y);
    return !found && found.error().code == ErrorCode::kBadRequest;
  };
  EXPECT_TRUE(refused(30, 0));
  EXPECT_TRUE(refused(0, 40));
  EXPECT_FALSE(refused(0, 39));
  camera.position->u = 1e9;
  EXPECT_TRUE(refused(0, 0));
}

TEST(FocusAt, OutsideThereIsNone) {
  const auto stream = strips({{0, 1}});
  const auto sight = [&](const Camera& camera) {
    return focus_at(*stream.decoder, camera, 20, 20)->sight;
  };
  EXPECT_EQ(sight(at_column(5.4)), PixelSight::kSurface);
  EXPECT_EQ(sight(at_column(5.6)), PixelSight::kOutside);
  Camera wide = at_column(3);
  wide.tan_half = 2;
  EXPECT_EQ(sight(wide), PixelSight::kSurface);
  EXPECT_EQ(focus_at(*stream.decoder, wide, 0, 20)->sight, PixelSight::kOutside);
}

// The true disparities of the cards.
struct Truth {
  scenes::SceneParams params;
  std::map<std::pair<uint32_t, uint32_t>, std::vector<float>> maps{};  // by row and column

  explicit Truth(uint32_t views, double baseline) {
    params.scene = scenes::Scene::kCards;
    params.rows = params.cols = views;
    params.width = 192;
    params.height = 144;
    params.baseline_px = baseline;
    std::mutex mutex;
    scenes::render_disparities(params, 2, {},
                               [&](uint32_t r, uint32_t c, std::span<const float> map) {
                                 const std::scoped_lock lock(mutex);
                                 maps[{r, c}].assign(map.begin(), map.end());
                               });
  }

  double at(uint32_t row, uint32_t col, uint32_t x, uint32_t y) const {
    return double{maps.at({row, col})[size_t{y} * params.width + x]};
  }

  // Greatest less least of the pixels that are at most 12 away on each axis.
  double range_around(uint32_t row, uint32_t col, uint32_t x, uint32_t y) const {
    double least = at(row, col, x, y);
    double greatest = least;
    for (uint32_t j = y - 12; j <= y + 12; ++j) {
      for (uint32_t i = x - 12; i <= x + 12; ++i) {
        least = std::min(least, at(row, col, i, j));
        greatest = std::max(greatest, at(row, col, i, j));
      }
    }
    return greatest - least;
  }
};

// From pixels whose surroundings, 12 pixels to each side, have one depth: a card, or the cloth.
TEST(FocusAt, IsTheTrueDisparityOfACard) {
  const Truth used(3, 6);
  const Truth fine(5, 3);
  ASSERT_NEAR(used.at(1, 1, 50, 50), 2 * fine.at(2, 2, 50, 50), 1e-5);
  const test::OpenedStream stream(encode(scenes::render_scene(used.params, 2), {})->bytes);
  int asked = 0;
  int mirrored = 0;
  for (uint32_t view = 0; view < 25; ++view) {
    const uint32_t row = view / 5;
    const uint32_t col = view % 5;
    Camera camera;
    camera.position = {col / 2.0, row / 2.0, 0};
    for (uint32_t y = 12; y < 132; y += 6) {
      for (uint32_t x = 12; x < 180; x += 6) {
        if (2 * fine.range_around(row, col, x, y) > 0.25) continue;
        ++asked;
        const double found = focus_at(*stream.decoder, camera, x, y)->focus();
        EXPECT_NEAR(found, 2 * fine.at(row, col, x, y), 0.3) << view << " " << x << " " << y;
        // Counts where a focus at the wrong pixel would be another.
        if (std::abs(found - 2 * fine.at(row, col, 191 - x, y)) > 0.3) ++mirrored;
      }
    }
  }
  EXPECT_GT(asked, 400);
  EXPECT_GT(mirrored, asked / 4);
}

}  // namespace
}  // namespace hmlfc
