// One light field being encoded, possibly several times with different thresholds or qualities.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <hmlfc/encoder.hpp>

#include "encoder/decisions.hpp"

namespace hmlfc {

/// Who watches an encoder at work; both may be empty. Called by several threads at once.
struct EncodeObserver {
  std::function<void()> image_done;
  /// What a decoder will make of image `at` of level `level`, key images too.
  std::function<void(int level, ImagePos at, const ImagePlanes&)> reconstructed;
};

/// The planes of the key images in the order of KEY-1: codestreams and CRCs of their samples.
struct CodedKeys {
  std::vector<std::vector<uint8_t>> codestreams;
  std::vector<uint32_t> crcs;
};

/// All images of a light field, coded.
struct CodedImages {
  std::vector<ImageCode> codes;  ///< by image number
  CodedKeys keys;
  ErrorSums error;  ///< of all views
};

/// The pipeline of both profiles: views to planes, planes to the tree of originals, levels from the
/// top down, key images, stream. What does not depend on thresholds and quality is made once.
class EncodeSession {
 public:
  /// `light_field` and `probe` must outlive the session. `header` comes from header_for(); its
  /// row_scale is that of `probe`.
  EncodeSession(const LightField& light_field, const StreamHeader& header,
                const LightFieldProbe& probe);

  const Geometry& geometry() const { return geometry_; }

  /// Codes all images with `params`, from which the header was made except for thresholds and
  /// quality. `last`: the originals may be used up. `sample`: of level 0 only these predictive
  /// images, for a trial, which gives no stream and leaves `error` 0; null: everything.
  CodedImages encode(const EncodeParams& params, bool last, const EncodeObserver& observer,
                     const std::vector<ImagePos>* sample = nullptr);

  /// The whole stream; uses up `images`.
  std::vector<uint8_t> stream(CodedImages& images) const;

 private:
  const LightField& light_field_;
  StreamHeader header_;
  const LightFieldProbe& probe_;
  Geometry geometry_;
  RkvTree originals_;
  CodedKeys lossless_keys_;  // once coded, they serve every encoding
};

}  // namespace hmlfc
