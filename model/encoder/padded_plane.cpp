#include "encoder/padded_plane.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace hmlfc {
namespace {

// The padding of a plane to search in, whose rows are a multiple of 32 samples apart.
Padding search_padding(uint32_t width, int window) {
  const int right = window + ReferencePlane::kMaxBlock + ReferencePlane::kReadAhead;
  const auto rest = static_cast<int>((int64_t{width} + window + right) % 32);
  return {window, right + (32 - rest) % 32, window + ReferencePlane::kMaxBlock};
}

}  // namespace

PaddedPlane::PaddedPlane(std::span<const int16_t> samples, size_t row_stride, uint32_t width,
                         uint32_t height, const Padding& padding)
    : before_(padding.before), stride_(before_ + static_cast<ptrdiff_t>(width) + padding.right) {
  const ptrdiff_t rows = static_cast<ptrdiff_t>(height) + padding.before + padding.below;
  samples_.resize(static_cast<size_t>(stride_ * rows));
  for (ptrdiff_t row = 0; row < rows; ++row) {
    const auto y = std::clamp<int64_t>(row - before_, 0, int64_t{height} - 1);
    const auto in = samples.subspan(static_cast<size_t>(y) * row_stride, width);
    int16_t* out = samples_.data() + row * stride_;
    std::fill_n(out, before_, in.front());
    std::copy(in.begin(), in.end(), out + before_);
    std::fill(out + before_ + width, out + stride_, in.back());
  }
}

ReferencePlane::ReferencePlane(std::span<const int16_t> samples, uint32_t width, uint32_t height,
                               int max_window)
    : width_(width),
      height_(height),
      max_window_(max_window),
      samples_(samples, width, width, height, search_padding(width, max_window)) {
  assert(width >= 1 && height >= 1 && samples.size() == size_t{width} * height);
  assert(max_window >= 0 && max_window <= kMaxWindow);
  assert(std::all_of(samples.begin(), samples.end(),
                     [](int sample) { return std::abs(sample) <= kMaxAbs; }));
}

}  // namespace hmlfc
