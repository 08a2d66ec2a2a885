// Motion and disparity tile records written field by field from MOT-3 and MOT-6.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "bits/naive_bits.hpp"

namespace hmlfc::test {

/// One palette entry.
struct EntryModel {
  unsigned reference_set = 0;
  unsigned choice = 0;
  bool negative = false;
  int explicit_x = 0;
  int explicit_y = 0;
};

/// What the stream says about motion tiles: which fields they have.
struct MotionRules {
  bool two_references = false;
  bool disparities = false;
  bool signs = false;
  unsigned least_block = 0;  ///< least motion_block with m >= B
};

/// One motion tile of a predictive image. The fields need not lie in their intervals; they are
/// written as they are.
struct MotionModel {
  MotionRules rules;
  unsigned motion_block = 0;
  unsigned explicit_bits = 0;
  std::vector<EntryModel> palette{1};
  uint32_t columns = 1;  ///< motion blocks that lie at least partly in the plane
  uint32_t rows = 1;
  std::vector<uint32_t> indices{0};  ///< row by row

  uint32_t side() const { return 4u << motion_block; }
};

NaiveBits write_motion(const MotionModel& tile);

/// A valid tile of `width` x `height` samples: any palette, all indices in use.
MotionModel draw_motion_tile(std::mt19937& random, const MotionRules& rules, uint32_t width,
                             uint32_t height);

/// One motion tile of a reference image.
struct DisparityModel {
  int least = 0;
  unsigned code = 0;
  uint32_t columns = 1;  ///< grid blocks
  uint32_t rows = 1;
  std::vector<uint32_t> values{0};  ///< row by row

  int at(uint32_t gx, uint32_t gy) const {
    return least + static_cast<int>(values[gy * columns + gx]);
  }
};

NaiveBits write_disparities(const DisparityModel& tile);

/// A valid tile of `width` x `height` samples with grid blocks of `side` samples.
DisparityModel draw_disparity_tile(std::mt19937& random, uint32_t width, uint32_t height,
                                   uint32_t side);

}  // namespace hmlfc::test
