// What trials find: their estimates against whole encodings, the groups they lead to, and the
// errors of key images.
#include "encoder/coding_trial.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "encoder/cached_views.hpp"
#include "encoder/coding_params.hpp"
#include "encoder/key_curve.hpp"
#include "encoder/trial_part.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

constexpr LightFieldShape kTrialShape{6, 6, 112, 96, 8};

EncodeParams settled_params(const LightField& field) {
  return settle_coding(FieldViews(field), with_defaults({})).params;
}

// The part of `views` on which `params` are tried.
CachedViews part_of(const ViewProvider& views, const EncodeParams& params) {
  const Rect part = trial_part(views, *header_for(views.shape(), params));
  return {views, part, CachedViews::kUnlimited};
}

TrialResult trial_of(const LightField& field, const SettledCoding& settled, size_t images) {
  const FieldViews views(field);
  return try_coding(views.shape(), part_of(views, settled.params), settled.params, settled.probe,
                    images);
}

TEST(CodingTrial, IsNearTheWholeEncoding) {
  const LightField field = test::textured_light_field(kTrialShape, 3, 6);
  const SettledCoding settled = settle_coding(FieldViews(field), with_defaults({}));
  const TrialResult trial = trial_of(field, settled, 100);
  const auto encoded = encode(field, settled.params);
  ASSERT_TRUE(encoded.has_value());
  const double bits = 8 * static_cast<double>(encoded->bytes.size());
  EXPECT_NEAR(trial.bits / bits, 1, 0.15);
  EXPECT_NEAR(trial.rgb_squares / static_cast<double>(encoded->error.rgb_squares), 1, 0.15);
}

// A third of the rows has nearly all of the bits: a trial that looked at these rows alone, or at
// the others, would be far from the whole.
TEST(CodingTrial, SeesAllRows) {
  const LightFieldShape shape{6, 6, 96, 192, 8};
  LightField field = test::textured_light_field(shape, 3, 6);
  const std::vector<uint16_t> grey(size_t{shape.width} * 3, 90);
  for (uint32_t view = 0; view < shape.rows * shape.cols; ++view) {
    for (uint32_t y = 0; y < shape.height; ++y) {
      if (y / 64 != 1) field.write_row(view / shape.cols, view % shape.cols, y, grey);
    }
  }
  const SettledCoding settled = settle_coding(FieldViews(field), with_defaults({}));
  const TrialResult trial = trial_of(field, settled, 10);
  const auto encoded = encode(field, settled.params);
  ASSERT_TRUE(encoded.has_value());
  EXPECT_NEAR(trial.bits / (8 * static_cast<double>(encoded->bytes.size())), 1, 0.15);
  EXPECT_NEAR(trial.rgb_squares / static_cast<double>(encoded->error.rgb_squares), 1, 0.15);
}

// Views whose blocks reach beyond them: red counts columns and green rows, so that the part's first
// pixel says where it lies.
TEST(CodingTrial, ThePartLiesInTheViews) {
  const LightFieldShape shape{1, 2, 399, 271, 8};
  LightField field(shape);
  RgbImage image{shape.width, shape.height, 8, {}};
  for (uint32_t y = 0; y < shape.height; ++y) {
    for (uint32_t x = 0; x < shape.width; ++x) {
      const uint32_t busy = x * 7 + y > 300 ? (x * y) % 50 : 0;
      for (const uint32_t value : {x % 256, y % 256, busy}) {
        image.samples.push_back(static_cast<uint16_t>(value));
      }
    }
  }
  field.set_view(0, 0, image);
  field.set_view(0, 1, image);
  EncodeParams params = with_defaults({});
  params.ref_rows = params.ref_cols = 2;
  params.chroma = ChromaFormat::k444;
  const FieldViews views(field);
  const CachedViews part = part_of(views, params);
  ASSERT_EQ(part.shape().width, 384u);
  ASSERT_EQ(part.shape().height, 256u);
  const RgbImage view = part.view({0, 1});
  const uint32_t left = view.samples[0];
  const uint32_t top = view.samples[1];
  EXPECT_LE(left + 384, shape.width);
  EXPECT_LE(top + 256, shape.height);
  EXPECT_EQ(view.samples[383 * 3], (left + 383) % 256);
  EXPECT_EQ(view.samples[(255 * 384 + 383) * 3 + 1], (top + 255) % 256);
}

// Waves whose direction and length depend on `seed`: easy to code, hard to predict from others.
RgbImage waves(uint32_t seed) {
  RgbImage image{kTrialShape.width, kTrialShape.height, 8, {}};
  const double across = 0.1 * (1 + seed % 5);
  const double down = 0.1 * (1 + seed % 7);
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const double wave = 128 + 60 * std::sin(across * x + down * y + seed);
      image.samples.insert(image.samples.end(), 3, static_cast<uint16_t>(wave));
    }
  }
  return image;
}

// Views that are all alike share one key image; views with nothing in common are key images.
TEST(CodingTrial, GroupsFollowTheViews) {
  LightField alike(kTrialShape);
  LightField unlike(kTrialShape);
  for (uint32_t row = 0; row < kTrialShape.rows; ++row) {
    for (uint32_t col = 0; col < kTrialShape.cols; ++col) {
      alike.set_view(row, col, waves(1));
      unlike.set_view(row, col, waves(row * kTrialShape.cols + col));
    }
  }
  const EncodeParams one = settled_params(alike);
  EXPECT_EQ(one.ref_rows, 6u);
  EXPECT_EQ(one.ref_cols, 6u);
  const EncodeParams many = settled_params(unlike);
  EXPECT_EQ(many.ref_rows, 1u);
  EXPECT_EQ(many.ref_cols, 1u);
}

TEST(CodingTrial, NothingIsOpenAfterwards) {
  const EncodeParams params = settled_params(test::textured_light_field(kTrialShape, 3, 6));
  EXPECT_GT(params.ref_rows, 0u);
  EXPECT_GT(params.ref_cols, 0u);
  EXPECT_GT(params.extended.disparity_grid, 0u);
  EXPECT_GT(params.extended.motion_tile, 0u);
  EXPECT_GT(params.extended.key_weight, 0);
  EXPECT_TRUE(params.chroma.has_value());
}

TEST(KeyCurve, ErrorsGrowWithLambdaAndFallWithWeight) {
  const LightField field = test::textured_light_field({1, 1, 96, 80, 8}, 1, 40);
  SamplePlane plane(96, 80);
  for (uint32_t y = 0; y < 80; ++y) {
    for (uint32_t x = 0; x < 96; ++x) {
      plane.row(y)[x] = static_cast<int16_t>(field.view(0, 0).samples[(y * 96 + x) * 3]);
    }
  }
  const KeyCurve curve(plane, {8, false});
  double last = 0;
  for (const int64_t lambda : {1 << 8, 1 << 11, 1 << 14, 1 << 17}) {
    const KeyPoint point = curve.cheapest(4, {lambda});
    EXPECT_GE(point.asked, last);
    EXPECT_GE(curve.cheapest(1, {lambda}).asked, point.asked);
    EXPECT_GT(point.bits, 0);
    last = point.asked;
  }
  EXPECT_GT(last, curve.cheapest(4, {1 << 8}).asked);
}

}  // namespace
}  // namespace hmlfc
