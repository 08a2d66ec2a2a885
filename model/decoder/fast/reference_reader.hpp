// Fast reading of reference values at any place, equal to gather_reference.
#pragma once

#include <cstdint>
#include <memory>

#include <hmlfc/error.hpp>

#include "decoder/block_motion.hpp"
#include "decoder/fast/sparse_plane.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// Values in memory: row j begins at data + j * stride.
struct ReferenceView {
  const int16_t* data = nullptr;
  size_t stride = 0;
};

/// One plane of one reference image: a key image or sparse residuals (DEC-4, EXT-5).
class ReferenceReader {
 public:
  /// Reference image `reference` of level `level`.
  static Result<ReferenceReader> open(const FastSources& sources, int level, ImagePos reference,
                                      Plane plane);

  /// The values of ref in `area` with the border rule (DEC-5): in the plane itself, or in `buffer`,
  /// which has room for them all.
  Result<ReferenceView> view(const ReferenceArea& area, int16_t* buffer) const {
    const bool whole = is_inside(area);
    if (!whole || !key_) return copied_view(area, whole, buffer);
    const size_t first = static_cast<size_t>(area.y) * plane_.width + static_cast<size_t>(area.x);
    return ReferenceView{key_->samples.data() + first, plane_.width};
  }

 private:
  ReferenceReader(const PlaneShape& plane, unsigned block_size)
      : plane_(plane), block_size_(block_size) {}

  bool is_inside(const ReferenceArea& area) const {
    return area.x >= 0 && area.y >= 0 &&
           area.x + static_cast<int32_t>(area.columns) <= static_cast<int32_t>(plane_.width) &&
           area.y + static_cast<int32_t>(area.rows) <= static_cast<int32_t>(plane_.height);
  }

  Result<ReferenceView> copied_view(const ReferenceArea& area, bool whole, int16_t* buffer) const;
  void read_key(const ReferenceArea& area, int16_t* out) const;
  Result<void> read_clamped(const ReferenceArea& area, int16_t* out) const;
  Result<void> read_sparse(const ReferenceArea& area, int16_t* out) const;
  Result<int16_t> sample(uint32_t x, uint32_t y) const;

  PlaneShape plane_;
  unsigned block_size_;
  std::shared_ptr<const SamplePlane> key_;  // exactly one of these two is set
  std::shared_ptr<const SparsePlane> sparse_;
};

}  // namespace hmlfc
