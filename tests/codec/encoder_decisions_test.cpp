// Which blocks the encoder codes and what it halves, seen in the decoded views; what it decides for
// parameters that are left open.
#include <gtest/gtest.h>

#include <set>
#include <utility>
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

// Of noise whose residuals are all dropped, only the reference images survive (STR-4): row 1 of
// rows 0 to 3 and row 5 of rows 4 to 6, column 1 of columns 0 to 2 and column 3 of columns 3 and 4.
TEST(EncoderDecisions, ReferenceImagesByHand) {
  EncodeParams params = full_chroma(Method::kMc);
  params.window = 2;
  params.ref_rows = 4;
  params.ref_cols = 3;
  params.main.threshold_pred = 1u << 30;
  const LightField field = test::textured_light_field({7, 5, 16, 16, 8}, 1, 255);
  const Grid views = decoded_views(field, params);
  std::set<std::pair<uint32_t, uint32_t>> exact;
  for (uint32_t row = 0; row < 7; ++row) {
    for (uint32_t col = 0; col < 5; ++col) {
      if (views[row][col] == field.view(row, col).samples) exact.insert({row, col});
    }
  }
  EXPECT_EQ(exact, (std::set<std::pair<uint32_t, uint32_t>>{{1, 1}, {1, 3}, {5, 1}, {5, 3}}));
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

// Halving loses nothing where squares of 2 x 2 pixels share their chroma: grey added to a colour
// moves Y alone.
TEST(EncoderDecisions, SquaresOfOneChromaSurviveHalving) {
  EncodeParams params = full_chroma(Method::kHmlfc);
  params.chroma = ChromaFormat::k420;
  test::Random random(1);
  for (const auto& [width, height] : {std::pair{12u, 8u}, {13u, 9u}, {1u, 7u}, {5u, 1u}}) {
    LightField field({2, 2, width, height, 8});
    for (uint32_t view = 0; view < 4; ++view) {
      RgbImage image{width, height, 8, std::vector<uint16_t>(size_t{width} * height * 3)};
      std::vector<uint32_t> colours((width / 2 + 1) * (height / 2 + 1) * 3);
      for (uint32_t& channel : colours) channel = random() % 190;
      for (uint32_t i = 0; i < width * height; ++i) {
        const uint32_t square = i / width / 2 * (width / 2 + 1) + i % width / 2;
        const uint32_t grey = random() % 66;
        for (uint32_t c = 0; c < 3; ++c) {
          image.samples[i * 3 + c] = static_cast<uint16_t>(colours[square * 3 + c] + grey);
        }
      }
      field.set_view(view / 2, view % 2, image);
    }
    const Grid views = decoded_views(field, params);
    for (uint32_t view = 0; view < 4; ++view) {
      EXPECT_EQ(views[view / 2][view % 2], field.view(view / 2, view % 2).samples)
          << width << " x " << height;
    }
  }
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

}  // namespace
}  // namespace hmlfc
