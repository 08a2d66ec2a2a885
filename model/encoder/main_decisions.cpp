// Profile main: the paper's tools, decided by the energies of blocks or by rate and distortion.
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "bits/parallel.hpp"
#include "encoder/decisions.hpp"
#include "encoder/main_plane.hpp"
#include "encoder/padded_plane.hpp"
#include "encoder/plane_targets.hpp"

namespace hmlfc {
namespace {

// An error of an image weighs so many times more for each level above the views, and in a reference
// image: other images take it over. Measured on light fields.
constexpr int64_t kWeightOfLevel = 3;
constexpr int64_t kWeightOfReference = 4;
// Six times as much is the most of Lambda.
constexpr int64_t kMostLambda = (int64_t{1} << 40) / 6;

class MainLevel final : public LevelDecisions {
 public:
  MainLevel(const EncodeParams& params, const LevelImages& images)
      : params_(params), images_(images), groups_(images.group_count()) {}

  void refine_keys(std::vector<ImagePlanes>&) override {}

  void take_key(ImagePos at, const ImagePlanes& decoded) override {
    for (const Plane plane : kPlanes) keep(at, plane, decoded[static_cast<size_t>(plane)]);
  }

  EncodedImage encode_reference(ImagePos at, const ImagePlanes& original) override {
    return encode_image(at, original, params_.main.threshold_ref, true);
  }

  PlaneCode decide_group(ImagePos) override { return {}; }

  EncodedImage encode_predictive(ImagePos at, const ImagePlanes& original) override {
    return encode_image(at, original, params_.main.threshold_pred, false);
  }

  void change_quality(double) override {}

 private:
  using References = std::array<std::optional<ReferencePlane>, kPlaneCount>;

  // Keeps what the images of the group of `at` refer to, if there are any.
  void keep(ImagePos at, Plane plane, const SamplePlane& samples) {
    if (!images_.part().predicts) return;
    const PlaneShape& shape = images_.geometry().plane(plane);
    groups_[images_.group_of(at)][static_cast<size_t>(plane)].emplace(
        cropped(samples, shape.width, shape.height).samples, shape.width, shape.height,
        images_.header().window);
  }

  EncodedImage encode_image(ImagePos at, const ImagePlanes& original, uint32_t threshold,
                            bool is_reference) {
    EncodedImage image;
    parallel_for(kPlaneCount, [&](size_t p) {
      const Plane plane = kPlanes[p];
      MainPlaneTask task{images_.geometry(),
                         plane,
                         images_.header().depth,
                         images_.header().window,
                         params_.method != Method::kMc,
                         threshold,
                         lambda(plane, threshold, is_reference),
                         original[p],
                         images_.parent(at, plane)};
      if (!is_reference) task.reference = &*groups_[images_.group_of(at)][p];
      EncodedPlane encoded = encode_main_plane(task);
      if (is_reference) keep(at, plane, encoded.residuals);
      image.code[p] = std::move(encoded.code);
      image.samples[p] = std::move(encoded.samples);
    });
    return image;
  }

  // What a bit is worth, about as much as `threshold` makes it; 0: not asked for, or nothing is to
  // be dropped.
  Lambda lambda(Plane plane, uint32_t threshold, bool is_reference) const {
    if (!params_.main.rate_distortion || threshold == 0) return {};
    int64_t scaled = int64_t{threshold} * threshold;
    for (int level = 0; level < images_.level(); ++level) scaled /= kWeightOfLevel;
    if (is_reference) scaled /= kWeightOfReference;
    scaled = std::clamp(scaled, int64_t{1}, kMostLambda);
    return plane_lambda({scaled}, plane, images_.header().chroma_format);
  }

  EncodeParams params_;
  const LevelImages& images_;
  std::vector<References> groups_;
};

}  // namespace

DecisionStrategy main_decisions(const EncodeParams& params) {
  return {{}, [params](const LevelImages& images) {
            return std::make_unique<MainLevel>(params, images);
          }};
}

}  // namespace hmlfc
