// The views of a light field as the frames of a video: Y4M (YUV4MPEG2), BT.709.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/image.hpp>
#include <hmlfc/light_field.hpp>

#include "io/files.hpp"
#include "io/grid.hpp"
#include "io/io_error.hpp"
#include "io/ycbcr.hpp"

namespace hmlfc::io {

/// The least bits of a video that keeps views of `depth` in [8, 12] bits exactly: 10, 12 or 14.
int exact_video_bits(int depth);

/// Where the samples of Cb and Cr lie along one side of a frame.
enum class ChromaSide : uint8_t {
  kEach,     ///< one for each pixel
  kCosited,  ///< one for two pixels, at the first of them
  kCentred,  ///< one for two pixels, half way between them
};

/// The planes of Cb and Cr of a frame.
struct ChromaPlanes {
  bool there = true;  ///< false: grey
  ChromaSide x = ChromaSide::kEach;
  ChromaSide y = ChromaSide::kEach;
};

/// A video opened for reading. Const functions may be called concurrently.
class Y4mReader {
 public:
  /// Opens `file`: 4:4:4, 4:2:2, 4:2:0 or grey of 8 to 16 bits, with frames of rows * cols views.
  /// Grid, order and depth are those that Y4mWriter has noted in the header, unless they are given;
  /// without a note the order is raster and the depth that of the video, at most 12. Errors: not
  /// readable, another format, damaged, samples of more bits than the header says (as those that
  /// stand in the upper bits of 16), no grid, a grid of another number of views.
  static IoResult<Y4mReader> open(const std::filesystem::path& file, std::optional<GridShape> grid,
                                  std::optional<FrameOrder> order);

  const LightFieldShape& shape() const { return shape_; }

  /// What views have lost, or what was guessed; for people, empty if nothing.
  const std::string& note() const { return note_; }

  /// View (row, col), which lies in the grid. Cb and Cr of a pixel between samples are interpolated
  /// from the two or four nearest.
  RgbImage view(uint32_t row, uint32_t col) const;

 private:
  explicit Y4mReader(MappedFile file) : file_(std::move(file)) {}

  MappedFile file_;
  LightFieldShape shape_;
  FrameOrder order_ = FrameOrder::kRaster;
  ChromaPlanes chroma_;
  VideoLevels levels_;
  std::string note_;
  std::vector<size_t> frames_;  // where the samples of each begin
};

/// A video being written, frame after frame.
class Y4mWriter {
 public:
  /// For a light field of `shape`; `bits` is 8, 10, 12 or 14, `shape.depth` at least. Views come
  /// back exactly where bits >= exact_video_bits(depth). Errors: cannot write.
  static IoResult<Y4mWriter> create(const std::filesystem::path& file, const LightFieldShape& shape,
                                    FrameOrder order, int bits);

  /// Appends a view of the shape; views come in the order of view_of_frame. Errors: cannot write.
  IoResult<void> add(const RgbImage& view);

  /// After the last view. Errors: cannot write.
  IoResult<void> commit() { return file_.commit(); }

 private:
  Y4mWriter(AtomicFile file, VideoLevels levels) : file_(std::move(file)), levels_(levels) {}

  AtomicFile file_;
  VideoLevels levels_;
};

}  // namespace hmlfc::io
