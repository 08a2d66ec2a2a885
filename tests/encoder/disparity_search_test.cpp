// The search finds the disparities of a made-up light field (MOT-6).
#include "encoder/disparity_search.hpp"

#include <random>

#include <gtest/gtest.h>

namespace hmlfc {
namespace {

constexpr uint32_t kWidth = 90;
constexpr uint32_t kHeight = 70;

SamplePlane noise_plane(uint32_t width, uint32_t height) {
  std::mt19937 random(5);
  SamplePlane plane(width, height);
  for (int16_t& sample : plane.samples) sample = static_cast<int16_t>(random() % 256);
  return plane;
}

// The image `rows` and `cols` steps from the reference, of a scene that moves `disparity` samples
// per step.
SamplePlane moved(const SamplePlane& reference, int32_t rows, int32_t cols, int32_t disparity) {
  SamplePlane plane(kWidth, kHeight);
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const auto from_x = static_cast<uint32_t>(
          clamp(static_cast<int32_t>(x) + disparity * cols, 0, static_cast<int32_t>(kWidth) - 1));
      const auto from_y = static_cast<uint32_t>(
          clamp(static_cast<int32_t>(y) + disparity * rows, 0, static_cast<int32_t>(kHeight) - 1));
      plane.row(y)[x] = reference.at(from_x, from_y);
    }
  }
  return plane;
}

struct Found {
  CoarseResult coarse;
  DisparityGrid grid;
};

Found search_for(int32_t disparity, int row_scale) {
  const SamplePlane reference = noise_plane(kWidth, kHeight);
  const PaddedPlane padded(reference, kWidth, kHeight, 40);
  std::vector<SamplePlane> planes;
  StreamHeader header;
  header.width = kWidth;
  header.height = kHeight;
  header.window = 30;
  header.vector_precision = header.disparity_precision = 3;
  header.motion_tile_log2 = 6;
  header.disparity_grid_log2 = 3;
  header.row_scale = row_scale;
  DisparitySearch search(header);
  const int sign = row_scale / 16;
  for (const auto& [rows, cols] : {std::pair{0, 1}, {1, 0}, {-1, 1}, {2, -2}}) {
    planes.push_back(moved(reference, sign * rows, cols, disparity));
    search.targets.push_back({nullptr, {&padded, rows, cols}, {}});
  }
  for (size_t i = 0; i < planes.size(); ++i) search.targets[i].plane = &planes[i];
  search.images = search.targets.size();
  search.lambda = {256};
  Found found;
  found.coarse = coarse_disparities(search, 48);
  found.grid = search_disparities(search, found.coarse.range);
  return found;
}

TEST(DisparitySearch, FindsAMovedPlane) {
  for (const int row_scale : {16, -16}) {
    for (const int32_t disparity : {-3, 0, 2, 5}) {
      const Found found = search_for(disparity, row_scale);
      EXPECT_EQ(found.grid.blocks_x, 12u);
      EXPECT_EQ(found.grid.blocks_y, 9u);
      EXPECT_LE(found.coarse.range.lo, 8 * disparity);
      EXPECT_GE(found.coarse.range.hi, 8 * disparity);
      for (const int16_t d : found.grid.values) EXPECT_EQ(d, 8 * disparity);
    }
  }
}

}  // namespace
}  // namespace hmlfc
