#include "encoder/plane_targets.hpp"

#include <algorithm>
#include <cmath>

#include "arithmetic/reconstruct.hpp"
#include "bits/parallel.hpp"
#include "syntax/geometry.hpp"

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

// The share of the error in an image predicted from one key image that is left: a second reference
// averages it, and residuals take some of it away.
constexpr double kSeenError = 0.8;
constexpr double kSeenErrorOfOne = 1;  // without a tree and with one key image: no second one

// Images of a group, as the curves are measured.
constexpr double kImagesOfCurves = 25;

double images_per_key(const Geometry& geometry) {
  return static_cast<double>(geometry.level(0).images()) /
         static_cast<double>(geometry.key_count());
}

// Returns the weight of the error in images predicted from a key image; of its own it is 1.
double key_weight(const StreamHeader& header) {
  const Geometry geometry(header);
  const bool one = header.tree_height == 0 && geometry.key_count() == 1;
  const double seen = one ? kSeenErrorOfOne : kSeenError;
  return seen * (images_per_key(geometry) - 1);
}

// The cheapest key image of groups of `images`. The fewer they are, the less noise does refinement
// take out: about as many bits as the logarithm of their number says.
KeyPoint cheapest_key(const std::vector<KeyCurve>& curves, double weight, Lambda lambda,
                      double images) {
  const KeyCurve& view = curves.front();
  if (curves.size() == 1 || images <= 1) return view.cheapest(weight, lambda);
  const auto cost = [&](const KeyCurve& curve) { return curve.cost(weight, lambda); };
  const auto refined = std::ranges::min_element(curves.begin() + 1, curves.end(), {}, cost);
  KeyPoint key = refined->cheapest(weight, lambda);
  const double unrefined = std::max(0.0, 1 - std::log(images) / std::log(kImagesOfCurves));
  if (unrefined > 0) key.bits += unrefined * (view.bits(key.asked) - key.bits);
  return key;
}

}  // namespace

Lambda lambda_of_quality(double quality) {
  // Rounded to 256ths, so that the exp2 of every machine gives the same.
  return {std::llround(256 * std::exp2((100 - quality) / 8))};
}

Lambda plane_lambda(Lambda lambda, Plane plane, ChromaFormat chroma) {
  const int64_t pixels = chroma == ChromaFormat::k420 ? 4 : 1;
  if (plane == Plane::kCo) return {lambda.scaled * 6 / pixels};
  if (plane == Plane::kCg) return {lambda.scaled * 4 / pixels};
  return lambda;
}

ResidualRules residual_rules(Lambda lambda, Plane plane, ChromaFormat chroma) {
  ResidualRules rules;
  rules.lambda = plane_lambda(lambda, plane, chroma);
  rules.step_code = step_code_of(rules.lambda);
  return rules;
}

SearchEffort effort_of(Preset preset) {
  switch (preset) {
    case Preset::kFast:
      return {3, 6, 0};
    case Preset::kSlow:
      return {9, 24, 16};
    case Preset::kMedium:
      break;
  }
  return {5, 12, 8};
}

PlaneTargets plane_targets(const StreamHeader& header, const EncodeParams& params,
                           const LightFieldProbe& probe) {
  const Lambda lambda = lambda_of_quality(params.extended.quality);
  const double weight = key_weight(header);
  PlaneTargets targets;
  parallel_for(kPlaneCount, [&](size_t p) {
    const Plane plane = kPlanes[p];
    PlaneTarget& target = targets[p];
    target.residuals = residual_rules(lambda, plane, header.chroma_format);
    target.residuals.lossless = params.lossless;
    if (params.lossless) return;
    target.key = cheapest_key(probe.keys[p], weight, target.residuals.lambda,
                              images_per_key(Geometry(header)));
  });
  return targets;
}

}  // namespace hmlfc
