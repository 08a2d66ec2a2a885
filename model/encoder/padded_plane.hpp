// A plane of reference samples with replicated borders, for interpolation at any vector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "decoder/sample_plane.hpp"

namespace hmlfc {

/// width x height samples and `pad` more on each side, each with the value of the nearest sample
/// inside (DEC-5). Immutable once built.
class PaddedPlane {
 public:
  /// `plane`: at least width x height samples, of which the rest is ignored.
  PaddedPlane(const SamplePlane& plane, uint32_t width, uint32_t height, int pad);

  /// The sample at (x, y), x in [-pad, width + pad - 1], y in [-pad, height + pad - 1].
  const int16_t* at(ptrdiff_t x, ptrdiff_t y) const {
    return samples_.data() + (y + pad_) * stride_ + (x + pad_);
  }
  ptrdiff_t stride() const { return stride_; }

 private:
  ptrdiff_t pad_;
  ptrdiff_t stride_;
  std::vector<int16_t> samples_;
};

}  // namespace hmlfc
