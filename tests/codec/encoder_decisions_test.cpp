// Which blocks the encoder codes and what it halves, seen in the decoded views; what it decides for
// parameters that are left open.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

using Grid = std::vector<std::vector<std::vector<uint16_t>>>;

// The samples of each view, decoded.
Grid decoded_views(const LightField& field, const EncodeParams& params) {
  const auto encoded = encode(field, params);
  const auto decoder = Decoder::open(encoded->bytes);
  Grid views(field.shape().rows);
  for (uint32_t row = 0; row < field.shape().rows; ++row) {
    for (uint32_t col = 0; col < field.shape().cols; ++col) {
      views[row].push_back(decoder->decode_view({row, col})->samples);
    }
  }
  return views;
}

// A row of 8 x 8 views, each of one grey.
LightField grey_views(const std::vector<uint16_t>& greys) {
  LightField field({1, static_cast<uint32_t>(greys.size()), 8, 8, 8});
  for (uint32_t col = 0; col < greys.size(); ++col) {
    field.set_view(0, col, {8, 8, 8, std::vector<uint16_t>(8 * 8 * 3, greys[col])});
  }
  return field;
}

EncodeParams full_chroma(Method method) {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.method = method;
  params.chroma = ChromaFormat::k444;
  params.main.threshold_ref = 0;
  params.main.threshold_pred = 0;
  return params;
}

// Each block of the second view differs from the first, its prediction, by 16.
TEST(EncoderDecisions, ThresholdOfPredictiveImagesIsTheLeastEnergyThatIsCoded) {
  EncodeParams params = full_chroma(Method::kMc);
  const LightField field = grey_views({100, 101});
  params.main.threshold_pred = 16;
  EXPECT_EQ(decoded_views(field, params)[0][1], field.view(0, 1).samples);
  params.main.threshold_pred = 17;
  EXPECT_EQ(decoded_views(field, params)[0][1], field.view(0, 0).samples);
}

// Each block of the first view, a reference image, differs from the mean of both by 16.
TEST(EncoderDecisions, ThresholdOfReferenceImagesIsTheLeastEnergyThatIsCoded) {
  EncodeParams params = full_chroma(Method::kHmlfc);
  const LightField field = grey_views({100, 102});
  params.main.threshold_ref = 16;
  EXPECT_EQ(decoded_views(field, params)[0][0], field.view(0, 0).samples);
  params.main.threshold_ref = 17;
  EXPECT_EQ(decoded_views(field, params)[0][0], grey_views({101}).view(0, 0).samples);
}

EncodedStream encoded_noise(const EncodeParams& params) {
  return *encode(test::textured_light_field({4, 4, 40, 30, 8}, 1, 5), params);
}

TEST(EncoderDecisions, OpenParametersOfProfileExtended) {
  const EncodedStream stream = encoded_noise({});
  const StreamHeader header = Decoder::open(stream.bytes)->header();
  EXPECT_EQ(header.profile, Profile::kExtended);
  EXPECT_EQ(header.tree_height, 0);
  EXPECT_EQ(header.window, 64);
  EXPECT_EQ(header.levels[0].ref_rows, stream.params.ref_rows);
  EXPECT_EQ(header.chroma_format, stream.params.chroma);
  EXPECT_EQ(encoded_noise(stream.params).bytes, stream.bytes);
}

TEST(EncoderDecisions, OpenParametersOfProfileMain) {
  EncodeParams params;
  params.profile = Profile::kMain;
  const StreamHeader header = Decoder::open(encoded_noise(params).bytes)->header();
  EXPECT_EQ(header.tree_height, 2);  // of 3: a grid of 4 x 4 can use no more
  EXPECT_EQ(header.window, 16);
  EXPECT_EQ(header.levels[0].ref_rows, 8);
  EXPECT_EQ(header.levels[0].ref_cols, 8);
  EXPECT_EQ(header.chroma_format, ChromaFormat::k420);
}

TEST(EncoderDecisions, LosslessKeepsEveryRgbValueInBothProfiles) {
  for (const Profile profile : {Profile::kMain, Profile::kExtended}) {
    EncodeParams params;
    params.profile = profile;
    params.lossless = true;
    const EncodedStream stream = encoded_noise(params);
    EXPECT_EQ(stream.params.chroma, ChromaFormat::k444);
    EXPECT_EQ(stream.error.rgb_squares, 0u);
  }
}

// 5x5 views of a wall that moves by (2, rise) pixels from column to column, by (-rise, 2) from row
// to row: with a rise the cameras are turned about their axes against the grid.
LightField wall(int32_t rise) {
  constexpr LightFieldShape kShape{5, 5, 96, 64, 8};
  std::mt19937 random(7);
  std::vector<uint16_t> grains(160 * 160);
  for (uint16_t& grain : grains) grain = static_cast<uint16_t>(64 + random() % 128);
  LightField field(kShape);
  for (int32_t row = 0; row < 5; ++row) {
    for (int32_t col = 0; col < 5; ++col) {
      RgbImage view{kShape.width, kShape.height, 8, {}};
      for (int32_t y = 0; y < 64; ++y) {
        for (int32_t x = 0; x < 96; ++x) {
          const int32_t at =
              (y + 32 + 2 * row + rise * col) / 4 * 160 + (x + 32 + 2 * col - rise * row) / 4;
          view.samples.insert(view.samples.end(), 3, grains[static_cast<size_t>(at)]);
        }
      }
      field.set_view(static_cast<uint32_t>(row), static_cast<uint32_t>(col), view);
    }
  }
  return field;
}

TEST(EncoderDecisions, VectorsPredictWhatDisparitiesCannot) {
  EncodeParams params;
  params.ref_rows = params.ref_cols = 5;
  const auto straight = encode(wall(0), params);
  const auto turned = encode(wall(1), params);
  params.extended.preset = Preset::kFast;  // without vectors
  const auto without = encode(wall(1), params);
  ASSERT_TRUE(straight && turned && without);
  EXPECT_LT(turned->bytes.size(), 2 * straight->bytes.size());
  EXPECT_GT(without->bytes.size(), 4 * straight->bytes.size());
  EXPECT_LE(turned->error.rgb_squares, without->error.rgb_squares);
}

}  // namespace
}  // namespace hmlfc
