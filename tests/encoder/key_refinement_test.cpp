// Refined key images of a made-up light field: a noisy picture that moves by one disparity.
#include "encoder/key_refinement.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "encoder/coding_params.hpp"
#include "encoder/motion_prediction.hpp"

namespace hmlfc {
namespace {

constexpr uint32_t kViewWidth = 93;
constexpr uint32_t kViewHeight = 70;
constexpr int32_t kNoise = 9;

struct Scene {
  ChromaFormat chroma;
  uint8_t depth;
  int32_t disparity;  // in eighths of a pixel per view
};

// A picture so smooth that interpolation keeps it.
double picture(double x, double y) { return 60 * std::sin(x / 9) * std::cos(y / 7); }

class KeyRefinementCase : public testing::TestWithParam<Scene> {
 protected:
  KeyRefinementCase() {
    EncodeParams params = with_defaults({});
    params.ref_rows = params.ref_cols = 5;
    params.chroma = GetParam().chroma;
    params.extended = {60, Preset::kMedium, 8};
    header_ = header_for({5, 5, kViewWidth, kViewHeight, GetParam().depth}, params).value();
    header_.row_scale = 16;
    geometry_.emplace(header_);
    grid_.blocks_x = ceil_div(kViewWidth, 8u);
    grid_.blocks_y = ceil_div(kViewHeight, 8u);
    grid_.values.assign(
        size_t{grid_.blocks_x} * grid_.blocks_y,
        static_cast<int16_t>(GetParam().disparity * (1 << header_.disparity_precision) / 8));
  }

  static constexpr ImagePos kKey{2, 2};

  // View `at` of the scene with noise of [-noise, noise].
  ImagePlanes view(ImagePos at, int32_t noise) {
    ImagePlanes planes;
    for (size_t p = 0; p < kPlaneCount; ++p) {
      const PlaneShape& shape = geometry_->plane(kPlanes[p]);
      const SampleRange range = sample_range(kPlanes[p], header_.depth);
      const double scale = static_cast<double>(kViewWidth) / shape.width;
      const double move = GetParam().disparity / 8.0;
      SamplePlane plane(shape.width, shape.height);
      for (uint32_t y = 0; y < shape.height; ++y) {
        for (uint32_t x = 0; x < shape.width; ++x) {
          const double value = picture(x * scale + move * col_offset(kKey, at),
                                       y * scale + move * row_offset(kKey, at));
          const int32_t drawn =
              static_cast<int32_t>(random_() % static_cast<unsigned>(2 * noise + 1)) - noise;
          plane.row(y)[x] = static_cast<int16_t>(
              clamp(static_cast<int32_t>(std::lround(value)) + drawn + (range.hi + range.lo) / 2,
                    range.lo, range.hi));
        }
      }
      planes[p] = in_whole_blocks(plane, shape, geometry_->block_size());
    }
    return planes;
  }

  void add_target(ImagePos at, ImagePlanes planes) {
    targets_.push_back({std::move(planes), at, {}, {}});
  }

  ImagePlanes refined(ImagePlanes key) {
    const Lambda lambda{256 * 40};
    refine_key({header_,
                *geometry_,
                kKey,
                grid_,
                targets_,
                targets_.size(),
                {lambda, lambda, lambda},
                {2, 2, 2}},
               key);
    return key;
  }

  double error(const ImagePlanes& a, const ImagePlanes& b, size_t plane) const {
    const PlaneShape& shape = geometry_->plane(kPlanes[plane]);
    double sum = 0;
    for (uint32_t y = 0; y < shape.height; ++y) {
      for (uint32_t x = 0; x < shape.width; ++x) {
        sum += std::pow(a[plane].at(x, y) - b[plane].at(x, y), 2);
      }
    }
    return sum / (static_cast<double>(shape.width) * shape.height);
  }

  StreamHeader header_;
  std::optional<Geometry> geometry_;
  DisparityGrid grid_;
  std::vector<RefinementTarget> targets_;
  std::mt19937 random_{3};
};

TEST_P(KeyRefinementCase, NoiseIsAveragedOut) {
  const ImagePlanes clean = view(kKey, 0);
  const ImagePlanes noisy = view(kKey, kNoise);
  for (const ImagePos at : {ImagePos{0, 0}, {0, 4}, {1, 3}, {2, 1}, {3, 2}, {4, 0}, {4, 4}}) {
    add_target(at, view(at, kNoise));
  }
  const ImagePlanes key = refined(noisy);
  for (size_t p = 0; p < kPlaneCount; ++p) {
    EXPECT_LT(error(key, clean, p), 0.5 * error(noisy, clean, p)) << "plane " << p;
  }
}

TEST_P(KeyRefinementCase, NoTargetsChangeNothing) {
  const ImagePlanes key = view(kKey, kNoise);
  const ImagePlanes same = refined(key);
  for (size_t p = 0; p < kPlaneCount; ++p) EXPECT_EQ(same[p].samples, key[p].samples);
}

INSTANTIATE_TEST_SUITE_P(Cases, KeyRefinementCase,
                         testing::Values(Scene{ChromaFormat::k444, 8, 0},
                                         Scene{ChromaFormat::k420, 8, 12},
                                         Scene{ChromaFormat::k444, 12, -21}));

}  // namespace
}  // namespace hmlfc
