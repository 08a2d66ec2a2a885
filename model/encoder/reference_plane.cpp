#include "encoder/reference_plane.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace hmlfc {

ReferencePlane::ReferencePlane(std::span<const int16_t> samples, uint32_t width, uint32_t height,
                               int max_window)
    : width_(width),
      height_(height),
      max_window_(max_window),
      stride_((ptrdiff_t{width} + ptrdiff_t{2} * max_window + kMaxBlock + kReadAhead + 31) / 32 *
              32),
      rows_(ptrdiff_t{height} + ptrdiff_t{2} * max_window + kMaxBlock) {
  assert(width >= 1 && height >= 1 && samples.size() == size_t{width} * height);
  assert(max_window >= 0 && max_window <= kMaxWindow);
  assert(std::all_of(samples.begin(), samples.end(),
                     [](int sample) { return std::abs(sample) <= kMaxAbs; }));
  store_samples(samples);
  store_square_sums();
}

void ReferencePlane::store_samples(std::span<const int16_t> samples) {
  samples_.resize(static_cast<size_t>(stride_ * rows_));
  for (ptrdiff_t row = 0; row < rows_; ++row) {
    const ptrdiff_t y = std::clamp<ptrdiff_t>(row - max_window_, 0, ptrdiff_t{height_} - 1);
    const int16_t* in = samples.data() + y * ptrdiff_t{width_};
    int16_t* out = samples_.data() + row * stride_;
    std::fill_n(out, max_window_, in[0]);
    std::copy_n(in, width_, out + max_window_);
    std::fill(out + max_window_ + width_, out + stride_, in[width_ - 1]);
  }
}

void ReferencePlane::store_square_sums() {
  // The last row and the last column have no square; no valid candidate reads them and they stay 0.
  square_sums_.resize(samples_.size());
  for (ptrdiff_t row = 0; row + 1 < rows_; ++row) {
    const int16_t* upper = samples_.data() + row * stride_;
    const int16_t* lower = upper + stride_;
    int16_t* out = square_sums_.data() + row * stride_;
    for (ptrdiff_t col = 0; col + 1 < stride_; ++col) {
      out[col] = static_cast<int16_t>(upper[col] + upper[col + 1] + lower[col] + lower[col + 1]);
    }
  }
}

}  // namespace hmlfc
