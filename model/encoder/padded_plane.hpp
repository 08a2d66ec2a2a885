// Planes of reference samples with replicated borders, for motion of any vector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "decoder/sample_plane.hpp"

namespace hmlfc {

/// Samples that are stored around a plane.
struct Padding {
  int before = 0;  ///< to the left and above
  int right = 0;
  int below = 0;
};

/// width x height samples with some more on each side, each with the value of the nearest sample
/// inside (DEC-5). Immutable once built.
class PaddedPlane {
 public:
  /// `samples`: rows of `row_stride` >= width samples.
  PaddedPlane(std::span<const int16_t> samples, size_t row_stride, uint32_t width, uint32_t height,
              const Padding& padding);

  /// `plane`: at least width x height samples, of which the rest is ignored; `pad` on each side.
  PaddedPlane(const SamplePlane& plane, uint32_t width, uint32_t height, int pad)
      : PaddedPlane(plane.samples, plane.width, width, height, {pad, pad, pad}) {}

  /// The sample at (x, y), which lies in the plane or its padding.
  const int16_t* at(int64_t x, int64_t y) const {
    return samples_.data() + static_cast<ptrdiff_t>((y + before_) * stride_ + x + before_);
  }
  ptrdiff_t stride() const { return stride_; }

 private:
  ptrdiff_t before_;
  ptrdiff_t stride_;
  std::vector<int16_t> samples_;
};

/// One plane of a reference view, prepared for search_motion().
///
/// Samples are int16 in [-16382, 16382]; a position outside the plane has the value of the nearest
/// sample inside (each coordinate clamped on its own). Those positions are stored, so that a search
/// never branches on a border.
///
/// Stored are (width + 2 * max_window + 40, rounded up to 32) x (height + 2 * max_window + 8)
/// samples of 2 bytes: 0.7 MB for 700x400 and a window of 16.
///
/// Immutable once built: any number of threads may search in one plane.
class ReferencePlane {
 public:
  static constexpr int kMaxBlock = 8;     ///< largest block side of a search
  static constexpr int kMaxWindow = 127;  ///< largest window of a search
  static constexpr int kMaxAbs = 16382;   ///< largest magnitude of a sample
  static constexpr int kReadAhead = 32;   ///< samples that may be read past the last one needed

  /// `samples`: width * height values, row-major, each in [-16382, 16382]. `width`, `height`:
  /// [1, 65536]. `max_window`: [0, 127], the largest window of the searches in this plane.
  ReferencePlane(std::span<const int16_t> samples, uint32_t width, uint32_t height, int max_window);

  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  int max_window() const { return max_window_; }

  /// Distance between vertically adjacent samples, in elements.
  ptrdiff_t stride() const { return samples_.stride(); }

  /// The sample at (x, y), x in [-max_window, width + max_window + 6], y in [-max_window, height +
  /// max_window + 6]. From there, 32 further samples to the right can be read.
  const int16_t* sample(int64_t x, int64_t y) const { return samples_.at(x, y); }

 private:
  uint32_t width_;
  uint32_t height_;
  int max_window_;
  PaddedPlane samples_;
};

}  // namespace hmlfc
