// One light field being encoded, possibly several times with different thresholds or qualities.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <hmlfc/encoder.hpp>

#include "encoder/coded_images.hpp"
#include "encoder/decisions.hpp"
#include "encoder/quality_trim.hpp"

namespace hmlfc {

/// Who watches an encoder at work; both may be empty. Called by several threads at once.
struct EncodeObserver {
  std::function<void()> image_done;
  /// Receives what a decoder will make of image `at` of level `level`, key images included.
  std::function<void(int level, ImagePos at, const ImagePlanes&)> reconstructed;
};

/// The pipeline of both profiles: views to planes, planes to the tree of originals, levels from the
/// top down, key images, stream. What does not depend on thresholds and quality is made once.
class EncodeSession {
 public:
  /// `views`, `probe` and `storage` must outlive the session. `header` comes from header_for(); its
  /// row_scale is that of `probe`. `storage` takes what is coded; null: memory does.
  EncodeSession(const ViewProvider& views, const StreamHeader& header, const LightFieldProbe& probe,
                CodeStorage* storage = nullptr);

  const StreamHeader& header() const { return header_; }

  const Geometry& geometry() const { return geometry_; }

  /// Codes all images with `params`, from which the header was made except for thresholds and
  /// quality. `last`: the originals may be used up. With what `trim` says of predicted views, if
  /// there is one, and then none where all begins again.
  std::optional<CodedImages> encode(const EncodeParams& params, bool last,
                                    const EncodeObserver& observer, QualityTrim* trim = nullptr);

  /// Nothing coded yet.
  CodedImages no_images() const;

  /// Codes the images of `part` in the same way, and adds those that it owns to `coded`, with their
  /// error.
  void encode_part(const EncodeParams& params, const EncodePart& part,
                   const EncodeObserver& observer, CodedImages& coded) const;

  /// The whole stream.
  std::vector<uint8_t> stream(const CodedImages& images) const;

 private:
  DecisionStrategy strategy_of(const EncodeParams& params) const;
  RkvTree originals(bool last);
  bool walk(const EncodeParams& params, const EncodePart& part, RkvTree& tree,
            const EncodeObserver& observer, CodedImages& coded, QualityTrim* trim = nullptr) const;

  const ViewProvider& views_;
  StreamHeader header_;
  const LightFieldProbe& probe_;
  CodeStorage* storage_;
  Geometry geometry_;
  std::optional<EncodePart> whole_;  // with originals_, once they are needed
  RkvTree originals_;
  CodedKeys lossless_keys_;  // once coded, they serve every encoding
};

}  // namespace hmlfc
