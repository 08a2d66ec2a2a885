// A PSNR that is met while its views are coded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/light_field.hpp>

#include "encoder/encode_goal.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// Trims the quality of predicted views, which are coded in rounds: each says what the rest needs,
/// so that all views together have a PSNR.
class QualityTrim {
 public:
  /// `quality`: that of key images. `db`: the PSNR that the views of `shape` are to have, or up to
  /// `more_db` more. `db_per_quality`: about what a step of quality gains.
  QualityTrim(double quality, const LightFieldShape& shape, double db, double more_db,
              double db_per_quality);

  /// The rounds in which `images`, predictive views, are coded: each is spread over all of them, at
  /// all distances from their references. The first and the last ones are small.
  static std::vector<std::vector<ImagePos>> rounds(const Geometry& geometry,
                                                   std::vector<ImagePos> images);

  /// Learns the squared errors of views: first of the key images, then of those of each round.
  /// False: all begins again, with other qualities.
  bool go_on(std::span<const uint64_t> squares);

  /// Of key images.
  double key_quality() const { return base_; }

  /// Of the next round, near that of key images.
  double quality() const { return quality_; }

  /// Whether key images of hardly less quality are too bad, and these too good.
  bool at_jump() const;

 private:
  void learn(std::span<const uint64_t> squares);
  bool begins_again();

  double base_;
  int depth_;
  size_t views_;
  double near_db_;
  double db_per_quality_;
  double wanted_squares_;  // of all views
  double aim_;             // what rounds aim at, likewise
  double quality_;
  size_t coded_ = 0;
  double squares_ = 0;
  // The means of what rounds say: the logarithm of a view's squared errors, and at which quality.
  double weight_ = 0;
  double log_error_ = 0;
  double mean_quality_ = 0;
  double log_of_quality_;  // what a step of quality takes from the logarithm
  double spread_ = 0;      // of the views of the last round, its standard error to its mean
  int begins_ = 0;
  std::optional<QualitySurplus> last_;   // with another quality of key images
  std::optional<QualitySurplus> below_;  // the highest that is too low
  std::optional<QualitySurplus> above_;  // the lowest that is not
};

}  // namespace hmlfc
