// encode_to_psnr finds the largest thresholds that reach the target.
#include <gtest/gtest.h>

#include <limits>

#include <hmlfc/encoder.hpp>

#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

double rgb_psnr(const EncodedStream& stream, const LightFieldShape& shape) {
  const uint64_t samples = uint64_t{shape.rows} * shape.cols * shape.width * shape.height * 3;
  return psnr(stream.error.rgb_squares, samples, shape.depth);
}

TEST(TargetPsnr, ReachesTheTargetAndNotMuchMore) {
  const LightFieldShape shape{4, 5, 80, 60, 8};
  const LightField field = test::textured_light_field(shape, 11, 20);
  EncodeParams params;
  params.profile = Profile::kMain;
  params.chroma = ChromaFormat::k444;
  for (const double target : {28.0, 33.0, 38.0, 43.0}) {
    const auto encoded = encode_to_psnr(field, params, target);
    ASSERT_TRUE(encoded.has_value());
    EXPECT_GE(rgb_psnr(*encoded, shape), target);
    EXPECT_EQ(encoded->params.main.threshold_pred, encoded->params.main.threshold_ref);
    if (rgb_psnr(*encoded, shape) < target + 0.02) continue;
    // Not within the tolerance: then one step more must miss the target.
    EncodeParams coarser = encoded->params;
    ++coarser.main.threshold_ref;
    ++coarser.main.threshold_pred;
    const auto missed = encode(field, coarser);
    ASSERT_TRUE(missed.has_value());
    EXPECT_LT(rgb_psnr(*missed, shape), target);
  }
}

TEST(TargetPsnr, OutOfReachGivesTheBestThereIs) {
  const LightFieldShape shape{2, 2, 32, 32, 8};
  const LightField field = test::textured_light_field(shape, 1, 255);
  const auto encoded = encode_to_psnr(field, {.profile = Profile::kMain}, 90);
  ASSERT_TRUE(encoded.has_value());
  EXPECT_EQ(encoded->params.main.threshold_pred, 0u);
  EXPECT_LT(rgb_psnr(*encoded, shape), 90);
}

TEST(TargetPsnr, RefusesTargetsThatMakeNoSense) {
  const LightField field = test::textured_light_field({1, 1, 8, 8, 8}, 1, 0);
  for (const double target : {0.0, -5.0, 101.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(encode_to_psnr(field, {.profile = Profile::kMain}, target).has_value());
  }
}

}  // namespace
}  // namespace hmlfc
