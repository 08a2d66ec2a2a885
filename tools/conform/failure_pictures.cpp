#include "conform/failure_pictures.hpp"

#include <algorithm>

#include "io/pictures.hpp"
#include "io/write_image.hpp"

namespace hmlfc::conform {
namespace {

constexpr uint32_t kMaxSide = 2048;
constexpr int32_t kGain = 16;
constexpr uint16_t kGap = 96;

RgbImage to_8_bits(RgbImage image) {
  for (uint16_t& sample : image.samples) {
    sample = static_cast<uint16_t>(sample >> (image.depth - 8));
  }
  image.depth = 8;
  return image;
}

// Dark red for a difference of 1, orange, then yellow for half of the range on.
void set_heat(RgbImage& image, size_t at, uint32_t worst, int depth) {
  uint16_t* pixel = image.samples.data() + at * 3;
  if (worst == 0) {
    std::fill_n(pixel, 3, uint16_t{0});
    return;
  }
  unsigned steps = 0;  // floor(log2(worst)), [0, depth - 1]
  while (worst >> (steps + 1) != 0) ++steps;
  const auto heat = static_cast<uint16_t>(255 * (steps + 1) / static_cast<unsigned>(depth));
  pixel[0] = static_cast<uint16_t>(128 + heat / 2);
  pixel[1] = heat;
  pixel[2] = 0;
}

}  // namespace

RgbImage heat_map(const std::vector<BlockMap>& maps, uint32_t cols, size_t first, int depth) {
  const uint32_t columns = maps.front().columns;
  const uint32_t rows = maps.front().rows;
  auto grid_rows = static_cast<uint32_t>(maps.size()) / cols;
  uint32_t grid_cols = cols;
  size_t begin = 0;
  if (grid_cols * (columns + 1) > kMaxSide || grid_rows * (rows + 1) > kMaxSide) {
    grid_rows = grid_cols = 1;
    begin = first;
  }
  RgbImage image{grid_cols * (columns + 1) - 1, grid_rows * (rows + 1) - 1, 8, {}};
  image.samples.assign(size_t{image.width} * image.height * 3, kGap);
  for (uint32_t view = 0; view < grid_rows * grid_cols; ++view) {
    const uint32_t left = view % grid_cols * (columns + 1);
    const uint32_t top = view / grid_cols * (rows + 1);
    for (uint32_t by = 0; by < rows; ++by) {
      for (uint32_t bx = 0; bx < columns; ++bx) {
        set_heat(image, size_t{top + by} * image.width + left + bx,
                 maps[begin + view].worst[size_t{by} * columns + bx], depth);
      }
    }
  }
  return image;
}

io::IoResult<void> write_failure_pictures(const std::filesystem::path& folder,
                                          const RgbImage& expected, const RgbImage& actual,
                                          const RgbImage& heat) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return io::system_error(folder, "cannot be made", error.value());
  const auto difference = io::difference_picture(actual, expected, kGain);
  if (!difference) return tl::unexpected(difference.error());
  const RgbImage* pictures[] = {nullptr, nullptr, &*difference, &heat};
  const RgbImage shown[] = {to_8_bits(expected), to_8_bits(actual)};
  pictures[0] = &shown[0];
  pictures[1] = &shown[1];
  for (size_t i = 0; i < std::size(kFailurePictures); ++i) {
    if (auto done = io::write_png(folder / kFailurePictures[i], *pictures[i]); !done) return done;
  }
  return {};
}

}  // namespace hmlfc::conform
