#include "cli/outside_share.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "render/ray.hpp"

namespace hmlfc::cli {

double OutsideShare::add(const FrameRecord& record, const RgbImage& image) {
  uint64_t outside = 0;
  const uint16_t* pixel = image.samples.data();
  for (int32_t j = 0; j < record.frame_height; ++j) {
    for (int32_t i = 0; i < record.frame_width; ++i, pixel += 3) {
      if ((pixel[0] | pixel[1] | pixel[2]) == 0 && !trace(record, i, j)) ++outside;
    }
  }
  const double share = static_cast<double>(outside) /
                       (static_cast<double>(record.frame_width) * record.frame_height);
  if (share > most_) {
    most_ = share;
    emptiest_ = frames_;
  }
  sum_ += share;
  ++frames_;
  return share;
}

std::string OutsideShare::text(const StreamHeader& header) const {
  if (most_ == 0) return "";
  const auto percent = [](double share) { return fmt::format("{:.2f} %", 100 * share); };
  std::string line = percent(sum_ / static_cast<double>(frames_)) +
                     " of the pixels lie outside the light field and are black";
  if (frames_ > 1) line += fmt::format(", at most {} in frame {}", percent(most_), emptiest_);
  return line +
         fmt::format(
             "\nTheir rays miss the views: move the camera towards columns 0 to {}, rows 0 to {} "
             "and distance 0, or narrow --fov\n",
             header.cols - 1, header.rows - 1);
}

}  // namespace hmlfc::cli
