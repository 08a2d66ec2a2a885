#include "encoder/plane_targets.hpp"

#include <cmath>
#include <limits>
#include <new>

#include "arithmetic/reconstruct.hpp"
#include "bits/parallel.hpp"
#include "decoder/jpeg2000.hpp"
#include "encoder/view_planes.hpp"

namespace hmlfc {
namespace {

// The step at which quantisation costs about what its bits save: its square is about 10 lambda.
unsigned step_code_of(Lambda lambda) {
  unsigned code = 0;
  while (code < kMaxStepCode) {
    const int64_t here = step_of_code(code);
    const int64_t next = step_of_code(code + 1);
    if (here * next * 256 > 10 * lambda.scaled) break;
    ++code;
  }
  return code;
}

// Lambda of a plane: a squared error of Cg counts a quarter and one of Co a sixth of one of Y in
// RGB, on four pixels in 4:2:0.
Lambda plane_lambda(Lambda lambda, Plane plane, ChromaFormat chroma) {
  const int64_t pixels = chroma == ChromaFormat::k420 ? 4 : 1;
  if (plane == Plane::kCo) return {lambda.scaled * 6 / pixels};
  if (plane == Plane::kCg) return {lambda.scaled * 4 / pixels};
  return lambda;
}

double mean_squared_error(const SamplePlane& a, const SamplePlane& b) {
  int64_t squares = 0;
  for (size_t i = 0; i < a.samples.size(); ++i) {
    const int64_t error = a.samples[i] - b.samples[i];
    squares += error * error;
  }
  return static_cast<double>(squares) / static_cast<double>(a.samples.size());
}

// The errors tried: the least, the ratio of each to the one before, their number.
constexpr double kLeastKeyError = 0.25;
constexpr double kKeyErrorRatio = 1.375;
constexpr int kKeyErrorCount = 23;
// The share of a key image's error that is seen in a prediction: two references average it.
constexpr double kSeenError = 0.4;

// What a key image costs and saves at different errors.
class KeyTrial {
 public:
  KeyTrial(const SamplePlane& plane, SamplePrecision precision, Lambda lambda,
           double images_per_key)
      : plane_(plane), precision_(precision), lambda_(lambda), images_per_key_(images_per_key) {}

  // The error that minimises D + lambda R over all images that use one key image.
  double best() {
    double error = kLeastKeyError;
    for (int i = 0; i < kKeyErrorCount; ++i, error *= kKeyErrorRatio) attempt(error);
    const double middle = best_;
    for (const double factor : {0.73, 0.85, 1.17}) attempt(middle * factor);
    return best_;
  }

 private:
  void attempt(double error) {
    const auto coded = encode_jpeg2000_lossy(plane_, precision_, error);
    if (!coded) throw std::bad_alloc();
    const auto decoded = decode_jpeg2000(*coded, plane_.width, plane_.height, precision_);
    if (!decoded) throw std::bad_alloc();
    const auto samples = static_cast<double>(plane_.samples.size());
    const double bits = 8 * static_cast<double>(coded->size()) / samples;
    const double cost = mean_squared_error(plane_, *decoded) * kSeenError * images_per_key_ +
                        static_cast<double>(lambda_.scaled) / 256 * bits;
    if (cost >= least_) return;
    least_ = cost;
    best_ = error;
  }

  const SamplePlane& plane_;
  SamplePrecision precision_;
  Lambda lambda_;
  double images_per_key_;
  double best_ = kLeastKeyError;
  double least_ = std::numeric_limits<double>::max();
};

void decide_key_errors(const LightField& light_field, const StreamHeader& header,
                       PlaneTargets& targets) {
  const Geometry geometry(header);
  const LevelShape& level = geometry.level(0);
  const ImagePos middle = geometry.reference_of(0, {level.rows / 2, level.cols / 2});
  const ImagePlanes planes = view_planes(light_field, geometry, middle);
  const double images_per_key =
      static_cast<double>(level.images()) / static_cast<double>(geometry.key_count());
  parallel_for(planes.size(), [&](size_t p) {
    const PlaneShape& shape = geometry.plane(kPlanes[p]);
    const SamplePlane inside = cropped(planes[p], shape.width, shape.height);
    targets[p].key_error = KeyTrial(inside, {header.depth + (p > 0 ? 1 : 0), p > 0},
                                    targets[p].residuals.lambda, images_per_key)
                               .best();
  });
}

}  // namespace

Lambda lambda_of_quality(double quality) {
  // Rounded to 256ths, so that the exp2 of every machine gives the same.
  return {std::llround(256 * std::exp2((100 - quality) / 8))};
}

SearchEffort effort_of(Preset preset) {
  switch (preset) {
    case Preset::kFast:
      return {5, 0};
    case Preset::kSlow:
      return {9, 2};
    case Preset::kMedium:
      break;
  }
  return {9, 1};
}

PlaneTargets plane_targets(const LightField& light_field, const StreamHeader& header,
                           const EncodeParams& params) {
  const Lambda lambda = lambda_of_quality(params.extended.quality);
  PlaneTargets targets;
  for (const Plane plane : kPlanes) {
    ResidualRules& rules = targets[static_cast<size_t>(plane)].residuals;
    rules.lossless = params.lossless;
    rules.lambda = plane_lambda(lambda, plane, header.chroma_format);
    rules.step_code = step_code_of(rules.lambda);
    rules.steps_around = effort_of(params.extended.preset).steps_around;
  }
  if (!params.lossless) decide_key_errors(light_field, header, targets);
  return targets;
}

}  // namespace hmlfc
