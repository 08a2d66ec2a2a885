// Generation loss: what was decoded is encoded again with the same parameters, many times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <tuple>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>
#include <hmlfc/measure.hpp>

#include "scenes/scene.hpp"

namespace hmlfc {
namespace {

constexpr int kGenerations = 20;

LightField scene_of(scenes::Scene scene) {
  scenes::SceneParams params;
  params.scene = scene;
  params.rows = 4;
  params.cols = 4;
  params.width = 48;
  params.height = 40;
  return scenes::render_scene(params, 1);
}

// All views of a stream as a light field.
LightField decoded(const std::vector<uint8_t>& bytes) {
  const auto decoder = Decoder::open(bytes);
  const StreamHeader& header = decoder->header();
  LightField field({header.rows, header.cols, header.width, header.height, header.depth});
  const auto put = [&](ViewPos view, RgbImage&& image) {
    field.set_view(view.row, view.col, image);
  };
  EXPECT_TRUE(decoder->decode_all(put, {.threads = 1}).has_value());
  return field;
}

// Root of the mean squared difference over all samples of RGB.
double distance(const LightField& a, const LightField& b) {
  ErrorSums sums;
  const LightFieldShape shape = a.shape();
  for (uint32_t r = 0; r < shape.rows; ++r) {
    for (uint32_t c = 0; c < shape.cols; ++c) sums.add(measure(a.view(r, c), b.view(r, c)));
  }
  const double samples = 3.0 * shape.rows * shape.cols * shape.width * shape.height;
  return std::sqrt(static_cast<double>(sums.rgb_squares) / samples);
}

struct Generations {
  std::vector<double> error;  // of each generation against the original
  std::vector<double> step;   // against the generation before
};

Generations generations(const LightField& original, const EncodeParams& params) {
  Generations found;
  LightField before = original;
  for (int n = 0; n < kGenerations; ++n) {
    const auto encoded = encode(before, params);
    EXPECT_TRUE(encoded.has_value());
    LightField after = decoded(encoded->bytes);
    found.error.push_back(distance(original, after));
    found.step.push_back(distance(before, after));
    before = std::move(after);
  }
  return found;
}

EncodeParams params_of(Profile profile, double quality, int tree_height) {
  EncodeParams params;
  params.profile = profile;
  params.window = 16;
  params.ref_rows = params.ref_cols = 8;
  params.chroma = ChromaFormat::k444;
  params.extended.preset = Preset::kFast;
  params.extended.quality = quality;
  params.tree_height = tree_height;
  params.main.threshold_ref = params.main.threshold_pred =
      static_cast<uint32_t>(75 * std::exp2((60 - quality) / 10));
  return params;
}

// Measured on three scenes at three qualities: no generation changes the views more than the first
// did, so n of them err by at most n times the error of one. Errors do add up, most with a tree;
// docs/stress.md has the figures printed here. The bounds leave a margin.
void expect_bounded(scenes::Scene scene, const EncodeParams& params, double max_growth) {
  const Generations found = generations(scene_of(scene), params);
  for (size_t n = 1; n < found.error.size(); ++n) {
    EXPECT_LE(found.step[n], found.step[0]) << "generation " << n + 1;
    EXPECT_LE(found.error[n], max_growth * found.error[0]) << "generation " << n + 1;
  }
  if (found.error[0] == 0) return;
  const double most = *std::ranges::max_element(found.error);
  std::cout << "in errors of the first generation: largest error " << most / found.error[0]
            << ", last change " << found.step.back() / found.error[0] << '\n';
}

class Generations20 : public testing::TestWithParam<std::tuple<scenes::Scene, double>> {
 protected:
  scenes::Scene scene() const { return std::get<0>(GetParam()); }
  double quality() const { return std::get<1>(GetParam()); }
};

TEST_P(Generations20, OfProfileMainGrowLittle) {
  expect_bounded(scene(), params_of(Profile::kMain, quality(), 3), 2.75);
}

TEST_P(Generations20, OfProfileExtendedWithATreeGrow) {
  expect_bounded(scene(), params_of(Profile::kExtended, quality(), 3), 6);
}

TEST_P(Generations20, OfProfileExtendedComeToRest) {
  EncodeParams params = params_of(Profile::kExtended, quality(), 0);
  params.window = 64;
  params.ref_rows = params.ref_cols = 0;
  expect_bounded(scene(), params, 2.25);  // noise: 1.3 to 2.1, by the images that are sampled
}

TEST_P(Generations20, WithoutLossAreTheOriginal) {
  EncodeParams params = params_of(Profile::kExtended, quality(), 3);
  params.lossless = true;
  const Generations found = generations(scene_of(scene()), params);
  for (const double error : found.error) EXPECT_EQ(error, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Generations20,
                         testing::Combine(testing::Values(scenes::Scene::kCards,
                                                          scenes::Scene::kGlass,
                                                          scenes::Scene::kNoise),
                                          testing::Values(30.0, 60.0, 90.0)));

}  // namespace
}  // namespace hmlfc
