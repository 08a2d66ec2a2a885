// Trials are checked by their estimates against whole encodings, the groups they lead to, and the
// errors of key images.
#include "encoder/coding_trial.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "encoder/cached_views.hpp"
#include "encoder/coding_params.hpp"
#include "encoder/key_curve.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

constexpr LightFieldShape kTrialShape{6, 6, 112, 96, 8};

SettledCoding settled(const LightField& field, bool lossless) {
  EncodeParams params;
  params.lossless = lossless;
  return settle_coding(FieldViews(field), with_defaults(params));
}

TEST(CodingTrial, IsNearTheWholeEncoding) {
  const LightField field = test::textured_light_field(kTrialShape, 3, 6);
  for (const bool lossless : {false, true}) {
    const SettledCoding coding = settled(field, lossless);
    const FieldViews views(field);
    const TrialParts parts = trial_parts(views, CachedViews::kUnlimited);
    const TrialResult trial = try_coding(kTrialShape, parts, coding.params, coding.probe, 100);
    const auto encoded = encode(field, coding.params);
    ASSERT_TRUE(encoded.has_value());
    const double bits = 8 * static_cast<double>(encoded->bytes.size());
    EXPECT_NEAR(trial.bits / bits, 1, 0.15);
    const auto squares = static_cast<double>(encoded->error.rgb_squares);
    EXPECT_NEAR(trial.rgb_squares, squares, 0.15 * squares);
  }
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
  LightField rows(kTrialShape);  // alike in each row
  for (uint32_t row = 0; row < kTrialShape.rows; ++row) {
    for (uint32_t col = 0; col < kTrialShape.cols; ++col) {
      alike.set_view(row, col, waves(1));
      unlike.set_view(row, col, waves(row * kTrialShape.cols + col));
      rows.set_view(row, col, waves(row));
    }
  }
  for (const bool lossless : {false, true}) {
    const EncodeParams one = settled(alike, lossless).params;
    EXPECT_EQ(std::pair(one.ref_rows, one.ref_cols), std::pair(6u, 6u));
    const EncodeParams many = settled(unlike, lossless).params;
    EXPECT_EQ(std::pair(many.ref_rows, many.ref_cols), std::pair(1u, 1u));
    const EncodeParams flat = settled(rows, lossless).params;
    EXPECT_EQ(std::pair(flat.ref_rows, flat.ref_cols), std::pair(1u, 6u));
  }
  EXPECT_EQ(encode_to(unlike, {}, TargetPsnr{90})->error.rgb_squares, 0u);
  // Few bytes are met, too, though trials for more of them settle for groups that take too many.
  const auto smallest = encode_to(unlike, {}, TargetBytes{1});
  const size_t most = smallest->bytes.size() * 6 / 5;
  EXPECT_LE(encode_to(unlike, {}, TargetBytes{most})->bytes.size(), most);
}

TEST(KeyCurve, ErrorsGrowWithLambdaAndFallWithWeight) {
  const LightField field = test::textured_light_field({1, 1, 96, 80, 8}, 1, 40);
  SamplePlane plane(96, 80);
  for (uint32_t y = 0; y < 80; ++y) {
    for (uint32_t x = 0; x < 96; ++x) {
      plane.row(y)[x] = static_cast<int16_t>(field.view(0, 0).samples[(y * 96 + x) * 3]);
    }
  }
  const auto alike = [&](const SamplePlane& coded) {
    const double error = mean_squared_error(plane, coded);
    return KeyErrors{error, error};
  };
  const KeyCurve curve(plane, 2, {8, false}, alike);
  double last = 0;
  for (const int64_t lambda : {1 << 8, 1 << 11, 1 << 14, 1 << 17}) {
    const KeyPoint point = curve.cheapest(4, {lambda});
    EXPECT_GE(point.asked, last);
    EXPECT_GE(curve.cheapest(1, {lambda}).asked, point.asked);
    EXPECT_GT(point.bits, 0);
    last = point.asked;
  }
  EXPECT_GT(last, curve.cheapest(4, {1 << 8}).asked);
  // Where predictions do not suffer, as from noise, a key image is worth less.
  const KeyCurve of_noise(plane, 2, {8, false}, [&](const SamplePlane& coded) {
    return KeyErrors{mean_squared_error(plane, coded), 30};
  });
  EXPECT_GT(of_noise.cheapest(4, {1 << 8}).asked, curve.cheapest(4, {1 << 8}).asked);
}

// OpenJPEG leaves far more of smooth planes than is asked of it, or nothing: an error is found that
// costs at most three times as much as any. (Without care it was 14 times.)
TEST(KeyCurve, FindsACheapErrorOfSmoothPlanes) {
  for (const double period : {20.0, 80.0}) {
    SamplePlane plane(192, 128);
    for (size_t i = 0; i < plane.samples.size(); ++i) {
      const double at = static_cast<double>(i % 192) + 0.3 * static_cast<double>(i / 192);
      plane.samples[i] = static_cast<int16_t>(128 + 12 * std::sin(at / period));
    }
    const auto alike = [&](const SamplePlane& coded) {
      const double error = mean_squared_error(plane, coded);
      return KeyErrors{error, error};
    };
    const KeyCurve curve(plane, 2, {8, false}, alike);
    for (const int64_t lambda : {1 << 8, 1 << 14, 1 << 17}) {
      for (double asked = 0.125; asked < 100; asked *= 2) {
        const CodedPlane coded = code_key_plane(plane, {8, false}, asked);
        const double bits = 8.0 * static_cast<double>(coded.codestream.size()) / (192 * 128);
        const double cost =
            5 * mean_squared_error(plane, coded.decoded) + static_cast<double>(lambda) / 256 * bits;
        EXPECT_LE(curve.cost(4, {lambda}), 3 * cost) << period << ' ' << lambda << ' ' << asked;
      }
    }
  }
}

}  // namespace
}  // namespace hmlfc
