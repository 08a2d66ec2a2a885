// The animation of all frames that hmlfc render --preview writes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <hmlfc/image.hpp>

namespace hmlfc::cli {

/// An animated PNG of at most the first 240 frames; a GIF or MP4 of all, by the program ffmpeg.
class Preview {
 public:
  /// Named *.png, *.gif or *.mp4; empty for none. Usage failure for another name, for a place where
  /// no file can be written, and where there is no ffmpeg for a GIF or MP4. `sign` and `force` are
  /// those of Replacing.
  Preview(std::filesystem::path file, std::string sign, bool force);

  /// Adds a frame, in their order.
  void add(const RgbImage& frame);

  /// Writes the animation. `folder` has the frames added, as frame_0000.png and so on; if there was
  /// one, it may be that PNG file itself. Failure (kOutput) where it cannot be written or ffmpeg
  /// fails; then there is no such file, or still the old one.
  void write(const std::filesystem::path& folder) const;

 private:
  void write_video(const std::filesystem::path& folder) const;

  std::filesystem::path file_;
  std::string sign_;
  std::vector<RgbImage> frames_;  // of an animated PNG
  size_t count_ = 0;
};

}  // namespace hmlfc::cli
