#include "encoder/padded_plane.hpp"

#include <algorithm>

namespace hmlfc {

PaddedPlane::PaddedPlane(const SamplePlane& plane, uint32_t width, uint32_t height, int pad)
    : pad_(pad), stride_(ptrdiff_t{width} + 2 * pad_) {
  const ptrdiff_t rows = ptrdiff_t{height} + 2 * pad_;
  samples_.resize(static_cast<size_t>(stride_ * rows));
  for (ptrdiff_t row = 0; row < rows; ++row) {
    const ptrdiff_t y = std::clamp<ptrdiff_t>(row - pad_, 0, ptrdiff_t{height} - 1);
    const auto in = plane.row(static_cast<uint32_t>(y)).first(width);
    int16_t* out = samples_.data() + row * stride_;
    std::fill_n(out, pad_, in.front());
    std::copy(in.begin(), in.end(), out + pad_);
    std::fill(out + pad_ + width, out + stride_, in.back());
  }
}

}  // namespace hmlfc
