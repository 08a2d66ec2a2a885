// Interface for what differs between the profiles' encoders: how the images of a level are coded.
// The level walk (encode_session.cpp) offers what can be decided on; a strategy gives back records.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <hmlfc/encoder.hpp>
#include <hmlfc/view_provider.hpp>

#include "encoder/coded_images.hpp"
#include "encoder/encode_part.hpp"
#include "encoder/light_field_probe.hpp"
#include "encoder/rkv_tree.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// A plane as it is coded, in whole blocks.
struct EncodedPlane {
  PlaneCode code;
  SamplePlane samples;    ///< what a decoder makes of it (DEC-3)
  SamplePlane residuals;  ///< TIL-10, 0 where there is none; set for reference images
};

/// An image as it is coded.
struct EncodedImage {
  ImageCode code;
  ImagePlanes samples;  ///< exactly what a decoder makes of `code` (DEC-3), in whole blocks
};

/// One level of the tree, as the walk offers it. Any number of threads may read it.
class LevelImages {
 public:
  /// The arguments must outlive it. `tree` holds what `part` needs of the reconstructed images of
  /// the levels above `level` and of the originals of `level`.
  LevelImages(const ViewProvider& views, const StreamHeader& header, const Geometry& geometry,
              const RkvTree& tree, int level, const EncodePart& part)
      : views_(views),
        header_(header),
        geometry_(geometry),
        tree_(tree),
        level_(level),
        part_(part.levels[static_cast<size_t>(level)]) {}

  int level() const { return level_; }
  const StreamHeader& header() const { return header_; }
  const Geometry& geometry() const { return geometry_; }
  const LevelShape& shape() const { return geometry_.level(level_); }

  /// Reference groups of the level, numbered row by row.
  size_t group_count() const { return size_t{shape().group_rows()} * shape().group_cols(); }
  size_t group_of(ImagePos at) const {
    const ImagePos g = geometry_.group_of(level_, at);
    return size_t{g.row} * shape().group_cols() + g.col;
  }

  /// What is worked on: images to code (STR-4), and images that are looked at.
  const LevelPart& part() const { return part_; }

  /// All predictive images of the group of `reference`, also those that are not to be coded.
  std::vector<ImagePos> members(ImagePos reference) const {
    return members_of(geometry_, level_, reference);
  }

  /// The original of image `at`, which is not coded yet. A copy; at level 0 converted from its
  /// view by each call.
  ImagePlanes original(ImagePos at) const;

  /// Plane `plane` of the image above `at`, reconstructed; null at the top, where it counts as 0.
  const SamplePlane* parent(ImagePos at, Plane plane) const;

 private:
  const ViewProvider& views_;
  const StreamHeader& header_;
  const Geometry& geometry_;
  const RkvTree& tree_;
  int level_;
  const LevelPart& part_;
};

/// The decisions of one level. The walk calls, in this order:
///
///  1. refine_keys() once, at a keyed level;
///  2. take_key() or encode_reference() for each reference image, from many threads;
///  3. decide_group() for each of part().groups, from one thread;
///  4. encode_predictive() for each predictive image, from many threads, and between such rounds
///     change_quality().
///
/// All but 2 are left out where part().predicts is false: references need not be kept then.
/// Decisions must not depend on the order of concurrent calls: a stream is the same for any number
/// of threads.
class LevelDecisions {
 public:
  virtual ~LevelDecisions() = default;

  /// `keys` are the originals of the images that part().references names, in this order. What they
  /// become is coded in their place, except for those that are known (LevelPart).
  virtual void refine_keys(std::vector<ImagePlanes>& keys) = 0;

  /// Key image `at`, in whole blocks, as a decoder has it.
  virtual void take_key(ImagePos at, const ImagePlanes& decoded) = 0;

  /// Codes a reference image that is no key image.
  virtual EncodedImage encode_reference(ImagePos at, const ImagePlanes& original) = 0;

  /// Decides what the images of the group of `reference` share. Returns the records of the motion
  /// plane of `reference`; none in a stream without shared disparities.
  virtual PlaneCode decide_group(ImagePos reference) = 0;

  /// Codes an image from its parent and the references of this level.
  virtual EncodedImage encode_predictive(ImagePos at, const ImagePlanes& original) = 0;

  /// Predictive images are coded as for `quality` from now on (profile extended).
  virtual void change_quality(double quality) = 0;
};

/// The decisions of one encoding, for fixed parameters.
struct DecisionStrategy {
  /// The mean squared error that each plane of the key images may have; 0: none, lossless.
  std::array<double, kPlaneCount> key_errors{};

  /// Begins a level; `images` outlives the result.
  std::function<std::unique_ptr<LevelDecisions>(const LevelImages& images)> begin_level;
};

/// Thresholds on energies and full search (the paper): main_decisions.cpp.
DecisionStrategy main_decisions(const EncodeParams& params);

/// Rate and distortion, with all tools of profile extended: extended_decisions.cpp.
DecisionStrategy extended_decisions(const StreamHeader& header, const EncodeParams& params,
                                    const LightFieldProbe& probe);

}  // namespace hmlfc
