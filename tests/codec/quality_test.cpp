// Quality of profile extended, target PSNR of both profiles, and what profile main must not change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "bits/crc32c.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

const LightFieldShape kShape{5, 4, 96, 72, 8};

EncodeParams extended() {
  EncodeParams params;
  params.ref_rows = params.ref_cols = 3;
  params.chroma = ChromaFormat::k444;
  return params;
}

double rgb_psnr(const EncodedStream& stream, int depth = kShape.depth) {
  const uint64_t samples = uint64_t{kShape.rows} * kShape.cols * kShape.width * kShape.height * 3;
  return psnr(stream.error.rgb_squares, samples, depth);
}

TEST(Quality, MoreQualityIsMorePsnrAndMoreBytes) {
  const LightField field = test::textured_light_field(kShape, 2, 12);
  double last_psnr = 0;
  size_t last_bytes = 0;
  for (const double quality : {20.0, 40.0, 60.0, 80.0, 100.0, 132.0}) {
    EncodeParams params = extended();
    params.extended.quality = quality;
    const auto encoded = encode(field, params);
    ASSERT_TRUE(encoded.has_value());
    EXPECT_GT(rgb_psnr(*encoded), last_psnr) << "quality " << quality;
    EXPECT_GT(encoded->bytes.size(), last_bytes) << "quality " << quality;
    last_psnr = rgb_psnr(*encoded);
    last_bytes = encoded->bytes.size();
  }
}

TEST(Quality, OutsideItsIntervalIsRefused) {
  const LightField field = test::textured_light_field({1, 1, 8, 8, 8}, 1, 0);
  const LightField deep = test::textured_light_field({1, 1, 8, 8, 10}, 1, 0);
  EncodeParams params = extended();
  for (const double quality : {-0.5, 132.5, std::numeric_limits<double>::quiet_NaN()}) {
    params.extended.quality = quality;
    EXPECT_FALSE(encode(field, params).has_value()) << quality;
  }
  params.extended.quality = -32;
  EXPECT_TRUE(encode(deep, params).has_value());
  params.extended.quality = -32.5;
  EXPECT_FALSE(encode(deep, params).has_value());
}

// Key images keep what costs few bits and most of the PSNR: their mean colour.
TEST(Quality, LowQualityKeepsColour) {
  LightField field = test::textured_light_field(kShape, 2, 0);
  for (uint32_t row = 0; row < kShape.rows; ++row) {
    for (uint32_t col = 0; col < kShape.cols; ++col) {
      RgbImage view = field.view(row, col);
      for (size_t i = 0; i < view.samples.size(); i += 3) {
        const auto grey = static_cast<uint16_t>(view.samples[i] / 16);
        view.samples[i] = grey;
        view.samples[i + 1] = static_cast<uint16_t>(grey + 12 + i / 3 % 7);
        view.samples[i + 2] = static_cast<uint16_t>(grey + 10);
      }
      field.set_view(row, col, std::move(view));
    }
  }
  EncodeParams params = extended();
  params.ref_rows = params.ref_cols = 5;
  double last = 0;
  for (double quality = 40; quality >= 0; quality -= 4) {
    params.extended.quality = quality;
    const auto encoded = encode(field, params);
    ASSERT_TRUE(encoded.has_value());
    EXPECT_GT(rgb_psnr(*encoded), last - 5) << "quality " << quality;
    last = rgb_psnr(*encoded);
  }
}

// OpenJPEG leaves far more error of a plain plane than is asked for.
TEST(Quality, PlainViewsKeepTheirColour) {
  LightField field({1, 1, 512, 384, 8});
  RgbImage view = field.view(0, 0);
  std::ranges::fill(view.samples, uint16_t{255});
  field.set_view(0, 0, std::move(view));
  for (const double quality : {0.0, 60.0, 132.0}) {
    EncodeParams params;
    params.extended.quality = quality;
    const auto encoded = encode(field, params);
    ASSERT_TRUE(encoded.has_value());
    EXPECT_EQ(encoded->error.rgb_squares, 0u) << "quality " << quality;
  }
}

TEST(Quality, GridsOutsideTheirIntervalAreRefused) {
  EncodeParams grid = extended();
  grid.extended.disparity_grid = 5;
  EXPECT_FALSE(encode(test::textured_light_field({1, 1, 8, 8, 8}, 1, 0), grid).has_value());
}

EncodeParams main_params() {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.chroma = ChromaFormat::k444;
  return params;
}

TEST(TargetPsnr, IsReachedAndNotMuchMore) {
  struct Kind {
    EncodeParams params;
    double tolerance;
    void (*coarsen)(EncodeParams&);  // by the least step
  };
  const LightField field = test::textured_light_field(kShape, 11, 12);
  for (const Kind& kind :
       {Kind{extended(), 0.03, [](EncodeParams& p) { p.extended.quality -= 0.125; }},
        Kind{main_params(), 0.02, [](EncodeParams& p) {
               EXPECT_EQ(p.main.threshold_pred, p.main.threshold_ref);
               ++p.main.threshold_ref;
               ++p.main.threshold_pred;
             }}}) {
    for (const double target : {30.0, 36.0, 41.0}) {
      const auto encoded = encode_to(field, kind.params, TargetPsnr{target});
      ASSERT_TRUE(encoded.has_value());
      EXPECT_GE(rgb_psnr(*encoded), target);
      EncodeParams coarser = encoded->params;
      kind.coarsen(coarser);
      if (rgb_psnr(*encoded) < target + kind.tolerance) continue;
      const auto missed = encode(field, coarser);
      ASSERT_TRUE(missed.has_value());
      EXPECT_LT(rgb_psnr(*missed), target);
    }
  }
}

TEST(TargetPsnr, IsReachedWithDeepSamples) {
  const LightField field = test::textured_light_field(
      {kShape.rows, kShape.cols, kShape.width, kShape.height, 12}, 11, 50);
  for (const double target : {30.0, 50.0}) {
    const auto encoded = encode_to(field, extended(), TargetPsnr{target});
    ASSERT_TRUE(encoded.has_value());
    EXPECT_GE(rgb_psnr(*encoded, 12), target);
    EXPECT_LT(rgb_psnr(*encoded, 12), target + 1);
    EXPECT_EQ(encoded->params.extended.quality < 0, target < 40);
  }
}

TEST(TargetPsnr, OutOfReachGivesTheBestThereIs) {
  const LightField field = test::textured_light_field(kShape, 1, 255);
  for (EncodeParams params : {extended(), main_params()}) {
    params.chroma = ChromaFormat::k420;
    const auto encoded = encode_to(field, params, TargetPsnr{90});
    ASSERT_TRUE(encoded.has_value());
    const bool main = params.profile == Profile::kMain;
    EXPECT_TRUE(main ? encoded->params.main.threshold_pred == 0
                     : encoded->params.extended.quality == kHighestQuality);
    EXPECT_LT(rgb_psnr(*encoded), 90);
  }
}

TEST(TargetPsnr, RefusesTargetsThatMakeNoSense) {
  const LightField field = test::textured_light_field({1, 1, 8, 8, 8}, 1, 0);
  for (const double target : {0.0, -5.0, 101.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(encode_to(field, main_params(), TargetPsnr{target}).has_value());
  }
}

TEST(TargetBytes, AreNotExceededAndUsed) {
  const LightField field = test::textured_light_field(kShape, 11, 12);
  for (const EncodeParams& params : {extended(), main_params()}) {
    const auto usual = encode(field, params);
    ASSERT_TRUE(usual.has_value());
    for (const size_t most : {usual->bytes.size() * 2 / 3, usual->bytes.size() * 3 / 2}) {
      const auto encoded = encode_to(field, params, TargetBytes{most});
      ASSERT_TRUE(encoded.has_value());
      EXPECT_LE(encoded->bytes.size(), most);
      if (encoded->bytes.size() > most * 98 / 100) continue;
      EncodeParams finer = encoded->params;
      if (finer.profile == Profile::kMain && finer.main.threshold_pred == 0) continue;
      finer.extended.quality += 0.125;
      if (params.profile == Profile::kMain) {
        --finer.main.threshold_ref;
        --finer.main.threshold_pred;
      }
      const auto larger = encode(field, finer);
      ASSERT_TRUE(larger.has_value());
      EXPECT_GT(larger->bytes.size(), most);
    }
  }
}

TEST(TargetBytes, TooFewGiveTheSmallestStreamAndNoneAreRefused) {
  const LightField field = test::textured_light_field(kShape, 11, 12);
  const auto smallest = encode_to(field, extended(), TargetBytes{1});
  ASSERT_TRUE(smallest.has_value());
  EXPECT_EQ(smallest->params.extended.quality, 0);
  EXPECT_FALSE(encode_to(field, extended(), TargetBytes{0}).has_value());
}

// The stream says where rows run against their parallax, or are nearer to each other than columns.
TEST(Quality, RowsMayRunAgainstTheirParallax) {
  const LightField field = test::textured_light_field(kShape, 2, 0);
  LightField flipped(kShape);
  for (uint32_t row = 0; row < kShape.rows; ++row) {
    for (uint32_t col = 0; col < kShape.cols; ++col) {
      flipped.set_view(row, col, field.view(kShape.rows - 1 - row, col));
    }
  }
  const auto straight = encode(field, extended());
  const auto against = encode(flipped, extended());
  ASSERT_TRUE(straight.has_value() && against.has_value());
  const int one = Decoder::open(straight->bytes)->header().row_scale;
  const int other = Decoder::open(against->bytes)->header().row_scale;
  EXPECT_EQ(one, -other);
  EXPECT_EQ(std::abs(one), 8);  // a row moves the views by a pixel, a column by two
}

// Recorded with the release that had profile main alone: its streams stay as they were.
TEST(Quality, StreamsOfProfileMainAreUnchanged) {
  struct Record {
    Method method;
    size_t bytes;
    uint32_t crc;
  };
  const LightField field = test::textured_light_field(kShape, 3, 12);
  for (const Record& record :
       {Record{Method::kHmlfc, 238706, 0x8A5A771F}, Record{Method::kRlfc, 254258, 0xCFDC4A0B},
        Record{Method::kMc, 152841, 0xBEC28768}}) {
    EncodeParams params;
    params.profile = Profile::kMain;
    params.method = record.method;
    const auto encoded = encode(field, params);
    ASSERT_TRUE(encoded.has_value());
    EXPECT_EQ(encoded->bytes.size(), record.bytes);
    EXPECT_EQ(crc32c(encoded->bytes), record.crc);
  }
}

}  // namespace
}  // namespace hmlfc
