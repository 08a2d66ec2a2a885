// The plane a motion search looks into: samples, replicated borders and the sums its bounds need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hmlfc {

/// One plane of a reference view, prepared for search_motion().
///
/// Samples are int16 in [-16382, 16382]; a position outside the plane has the value of the nearest
/// sample inside (each coordinate clamped on its own). Those positions are stored, so that a search
/// never branches on a border.
///
/// Memory: 4 bytes a stored sample (2 the sample, 2 the sum of its 2x2 square). Stored are (width +
/// 2 * max_window + 40, rounded up to 32) x (height + 2 * max_window + 8) samples: 1.4 MB for
/// 700x400 and a window of 16.
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

  /// Distance between vertically adjacent samples (or sums), in elements.
  ptrdiff_t stride() const { return stride_; }

  /// The sample at (x, y), x in [-max_window, width + max_window + 6], y in [-max_window, height +
  /// max_window + 6]. From there, 32 further samples to the right can be read.
  const int16_t* sample(ptrdiff_t x, ptrdiff_t y) const { return samples_.data() + offset(x, y); }

  /// The sum of the samples (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1), modulo 2^16 in int16;
  /// same intervals as sample(), one less at the right and the bottom.
  const int16_t* square_sum(ptrdiff_t x, ptrdiff_t y) const {
    return square_sums_.data() + offset(x, y);
  }

 private:
  ptrdiff_t offset(ptrdiff_t x, ptrdiff_t y) const {
    return (y + max_window_) * stride_ + (x + max_window_);
  }
  void store_samples(std::span<const int16_t> samples);
  void store_square_sums();

  uint32_t width_;
  uint32_t height_;
  int max_window_;
  ptrdiff_t stride_;
  ptrdiff_t rows_;
  std::vector<int16_t> samples_;
  std::vector<int16_t> square_sums_;
};

}  // namespace hmlfc
