// One light field being encoded, possibly several times with different thresholds.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/encoder.hpp>
#include <hmlfc/error.hpp>

#include "encoder/level_encoder.hpp"
#include "encoder/rkv_tree.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// The header that `params` ask for, without its sections; bad_header_field where one is outside
/// its interval.
Result<StreamHeader> header_for(const LightFieldShape& shape, const EncodeParams& params);

/// All blocks of a light field, coded.
struct CodedImages {
  std::vector<ImageCode> codes;  ///< by image number
  ErrorSums error;               ///< of all views
};

/// What does not depend on the thresholds: tree of originals and key images.
class EncodeSession {
 public:
  /// `light_field` must outlive the session; `header` comes from header_for.
  EncodeSession(const LightField& light_field, const StreamHeader& header,
                const EncodeParams& params);

  const Geometry& geometry() const { return geometry_; }
  const std::vector<uint8_t>& top_section() const { return top_; }

  /// Encodes all levels with these thresholds. `last`: the tree of originals may be used up.
  CodedImages encode(uint32_t threshold_ref, uint32_t threshold_pred, bool last,
                     const EncodeObserver& observer);

  /// The whole stream; uses up `images`.
  std::vector<uint8_t> stream(CodedImages& images) const;

 private:
  std::vector<uint8_t> write_top() const;

  const LightField& light_field_;
  StreamHeader header_;
  EncodeParams params_;
  Geometry geometry_;
  RkvTree originals_;
  std::vector<uint8_t> top_;
};

}  // namespace hmlfc
