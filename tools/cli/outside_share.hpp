// The pixels of frames that see nothing of the light field.
#pragma once

#include <cstddef>
#include <string>

#include <hmlfc/camera.hpp>
#include <hmlfc/image.hpp>

namespace hmlfc::cli {

/// The share of pixels that lie outside (RAY-6), which are black, over some frames.
class OutsideShare {
 public:
  /// Adds a frame of `record`. Returns its own share, in [0, 1].
  double add(const FrameRecord& record, const RgbImage& image);

  /// How many there are in a stream of `header`, and what helps; empty where no pixel lies outside.
  std::string text(const StreamHeader& header) const;

 private:
  size_t frames_ = 0;
  double sum_ = 0;
  double most_ = 0;
  size_t emptiest_ = 0;  // the frame of most_
};

}  // namespace hmlfc::cli
