// Profile extended: rate and distortion, with all tools of the profile.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "bits/parallel.hpp"
#include "encoder/decisions.hpp"
#include "encoder/key_refinement.hpp"
#include "encoder/motion_decision.hpp"
#include "encoder/motion_prediction.hpp"
#include "encoder/plane_targets.hpp"
#include "encoder/residual_plane.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
namespace {

// How good and how thorough an encoding is.
struct Settings {
  PlaneTargets targets;
  Lambda lambda;  // of motion
  SearchEffort effort;
  DisparityRange disparities;  // tried for each group
};

// Planes from which the images of one group, and of its neighbours, are predicted.
struct GroupReference {
  std::array<std::optional<PaddedPlane>, kPlaneCount> planes;
  DisparityGrid grid;
};

class ExtendedLevel final : public LevelDecisions {
 public:
  ExtendedLevel(const Settings& settings, const LevelImages& images)
      : settings_(settings),
        images_(images),
        geometry_(images.geometry()),
        header_(images.header()),
        motion_(header_.has(Feature::kMotionTiles)),
        lambda_(settings.lambda),
        groups_(images.group_count()) {
    for (size_t p = 0; p < kPlaneCount; ++p) rules_[p] = settings.targets[p].residuals;
  }

  // Disparities are found in the originals: what they lose by that is not measurable, and so they
  // serve the refinement, too.
  void refine_keys(std::vector<ImagePlanes>& keys) override {
    if (!motion_) return;
    const LevelPart& part = images_.part();
    const auto& references = part.references;
    parallel_for(keys.size(), [&](size_t i) { take_key(references[i], keys[i]); });
    parallel_for(part.context.size(),
                 [&](size_t i) { take_key(part.context[i], images_.original(part.context[i])); });
    parallel_for(keys.size(), [&](size_t i) {
      const bool needed = std::ranges::find(part.groups, references[i]) != part.groups.end();
      if (part.known[i] && !needed) return;
      std::vector<RefinementTarget> sample = sampled_images(references[i]);
      find_disparities(references[i], sample);
      if (header_.has(Feature::kLossyKeys) && !part.known[i])
        refine(references[i], sample, keys[i]);
    });
    for (const ImagePos at : part.context) group(at).planes = {};
  }

  void take_key(ImagePos at, const ImagePlanes& decoded) override {
    for (const Plane plane : kPlanes) keep(at, plane, decoded[static_cast<size_t>(plane)]);
  }

  EncodedImage encode_reference(ImagePos at, const ImagePlanes& original) override {
    return encode_without_motion(at, original, true);
  }

  PlaneCode decide_group(ImagePos reference) override {
    if (!motion_) return {};
    if (!images_.shape().keyed) find_disparities(reference, sampled_images(reference));
    return disparity_records(group(reference).grid);
  }

  EncodedImage encode_predictive(ImagePos at, const ImagePlanes& original) override {
    if (!motion_) return encode_without_motion(at, original, false);
    EncodedImage image;
    const MotionSources sources = motion_sources(at);
    const std::vector<MotionTileCode> tiles = decide_tiles(sources, original[0]);
    const PaletteFields fields{header_.has(Feature::kTwoReferences), !sources.keyed};
    for (const MotionTileCode& tile : tiles) {
      image.code[kMotionPlane].append(write_motion_tile(tile, fields));
    }
    for (const Plane plane : kPlanes) {
      const SamplePlane prediction =
          predict_plane(sources, plane, images_.parent(at, plane),
                        reference_planes(sources.places, static_cast<size_t>(plane)), tiles);
      encode_plane(plane, original, prediction, false, image);
    }
    return image;
  }

  void change_quality(double quality) override {
    lambda_ = lambda_of_quality(quality);
    for (const Plane plane : kPlanes) {
      rules_[static_cast<size_t>(plane)] = residual_rules(lambda_, plane, header_.chroma_format);
    }
  }

 private:
  // Some images of the group of `reference`, with the plane that motion is decided on.
  std::vector<RefinementTarget> sampled_images(ImagePos reference) const {
    std::vector<RefinementTarget> sample;
    for (const ImagePos at :
         spread_images(images_.members(reference), settings_.effort.disparity_images)) {
      sample.push_back({images_.original(at), at, {}, {}});
      RefinementTarget& target = sample.back();
      target.planes[0] = motion_target(at, std::move(target.planes[0]));
    }
    return sample;
  }

  // Searches the disparities of the group of `reference`, if it has images to predict.
  void find_disparities(ImagePos reference, const std::vector<RefinementTarget>& sample) {
    if (sample.empty()) return;
    DisparitySearch search(header_);
    search.images = images_.members(reference).size();
    for (const RefinementTarget& image : sample) {
      search.targets.push_back(search_target(image.at));
      search.targets.back().plane = &image.planes[0];
    }
    search.keyed = images_.shape().keyed;
    search.lambda = settings_.lambda;
    group(reference).grid = search_disparities(search, settings_.disparities);
  }

  void refine(ImagePos reference, std::vector<RefinementTarget>& sample, ImagePlanes& key) {
    for (RefinementTarget& target : sample) {
      if (!header_.has(Feature::kTwoReferences)) break;
      const ImagePos other = reference_images(geometry_, images_.level(), target.at)[1];
      if (other == reference || !group(other).planes[0]) continue;
      target.other = other;
      for (size_t p = 0; p < kPlaneCount; ++p) target.other_planes[p] = &*group(other).planes[p];
    }
    const size_t images = images_.members(reference).size();
    KeyRefinement task{header_, geometry_, reference, group(reference).grid,
                       sample,  images,    {},        {}};
    for (size_t p = 0; p < kPlaneCount; ++p) {
      task.steps[p] = settings_.targets[p].key.steps;
      task.lambdas[p] = settings_.targets[p].residuals.lambda;
    }
    refine_key(task, key);
  }

  GroupReference& group(ImagePos at) { return groups_[images_.group_of(at)]; }

  // Keeps what images of the group of `at` and of its neighbours refer to, if there are any.
  void keep(ImagePos at, Plane plane, const SamplePlane& samples) {
    if (!images_.part().predicts) return;
    const PlaneShape& shape = geometry_.plane(plane);
    // Vectors reach `window` samples, interpolation one more, a block B - 1 beyond the plane.
    group(at).planes[static_cast<size_t>(plane)].emplace(samples, shape.width, shape.height,
                                                         header_.window + 10);
  }

  // Codes an image on top of its parent, or of 0 at the top.
  EncodedImage encode_without_motion(ImagePos at, const ImagePlanes& original, bool is_reference) {
    EncodedImage image;
    for (const Plane plane : kPlanes) {
      const auto p = static_cast<size_t>(plane);
      const SamplePlane* above = images_.parent(at, plane);
      const SamplePlane zeros(original[p].width, original[p].height);
      const SamplePlane residuals =
          encode_plane(plane, original, above != nullptr ? *above : zeros, is_reference, image);
      if (is_reference) keep(at, plane, residuals);
    }
    return image;
  }

  // Codes one plane on top of `prediction`; returns the residuals, set if `is_reference`.
  SamplePlane encode_plane(Plane plane, const ImagePlanes& original, const SamplePlane& prediction,
                           bool is_reference, EncodedImage& image) const {
    const auto p = static_cast<size_t>(plane);
    EncodedPlane encoded = encode_residuals(geometry_, plane, header_.depth, original[p],
                                            prediction, is_reference, rules_[p]);
    image.code[p] = std::move(encoded.code);
    image.samples[p] = std::move(encoded.samples);
    return std::move(encoded.residuals);
  }

  // The plane that motion is decided on: Y, at levels that are not keyed less the parent.
  SamplePlane motion_target(ImagePos at, SamplePlane luma) const {
    const SamplePlane* above = images_.shape().keyed ? nullptr : images_.parent(at, Plane::kY);
    if (above == nullptr) return luma;
    for (size_t i = 0; i < luma.samples.size(); ++i) {
      luma.samples[i] = static_cast<int16_t>(luma.samples[i] - above->samples[i]);
    }
    return luma;
  }

  // Where image `at` is predicted from unless a motion tile says otherwise: K0, and K1 if there is
  // one and a trial does not leave it out.
  SearchTarget search_target(ImagePos at) {
    const ReferenceImages places = reference_images(geometry_, images_.level(), at);
    const auto reference = [&](ImagePos place) {
      const auto& plane = group(place).planes[0];
      return SearchReference{plane ? &*plane : nullptr, row_offset(place, at),
                             col_offset(place, at)};
    };
    SearchTarget target{nullptr, reference(places[0]), {}};
    const bool two = header_.has(Feature::kTwoReferences) && images_.shape().keyed;
    if (two && places[1] != places[0]) target.second = reference(places[1]);
    return target;
  }

  // The records of the disparities of one group (MOT-6).
  PlaneCode disparity_records(const DisparityGrid& grid) const {
    const MotionPlaneShape& shape = geometry_.motion_planes()[0];
    const uint32_t per_tile = 1u << (header_.motion_tile_log2 - header_.disparity_grid_log2);
    PlaneCode code;
    for (uint32_t ty = 0; ty < shape.tiles_y; ++ty) {
      for (uint32_t tx = 0; tx < shape.tiles_x; ++tx) {
        std::vector<int16_t> values;
        for (uint32_t y = ty * per_tile; y < std::min((ty + 1) * per_tile, grid.blocks_y); ++y) {
          for (uint32_t x = tx * per_tile; x < std::min((tx + 1) * per_tile, grid.blocks_x); ++x) {
            values.push_back(grid.at(x, y));
          }
        }
        code.append(write_disparity_tile(values));
      }
    }
    return code;
  }

  MotionSources motion_sources(ImagePos at) {
    const VectorRules rules = vector_rules(header_);
    const ReferenceImages places = reference_images(geometry_, images_.level(), at);
    return {header_, geometry_, rules, at, images_.shape().keyed, places, group(at).grid};
  }

  ReferencePlanes reference_planes(const ReferenceImages& places, size_t plane) {
    ReferencePlanes planes{};
    for (size_t k = 0; k < places.size(); ++k) planes[k] = &*group(places[k]).planes[plane];
    return planes;
  }

  std::vector<MotionTileCode> decide_tiles(const MotionSources& sources, const SamplePlane& luma) {
    const SamplePlane target = motion_target(sources.at, luma);
    return decide_motion({sources, target, reference_planes(sources.places, 0),
                          settings_.effort.choices, settings_.effort.vectors, lambda_});
  }

  Settings settings_;
  const LevelImages& images_;
  const Geometry& geometry_;
  const StreamHeader& header_;
  bool motion_;
  Lambda lambda_;  // of motion
  std::array<ResidualRules, kPlaneCount> rules_;
  std::vector<GroupReference> groups_;
};

}  // namespace

DecisionStrategy extended_decisions(const StreamHeader& header, const EncodeParams& params,
                                    const LightFieldProbe& probe) {
  const Settings settings{plane_targets(header, params, probe),
                          lambda_of_quality(params.extended.quality),
                          effort_of(params.extended.preset), probe.disparities};
  DecisionStrategy strategy;
  for (size_t p = 0; p < kPlaneCount; ++p) strategy.key_errors[p] = settings.targets[p].key.asked;
  strategy.begin_level = [settings](const LevelImages& images) {
    return std::make_unique<ExtendedLevel>(settings, images);
  };
  return strategy;
}

}  // namespace hmlfc
