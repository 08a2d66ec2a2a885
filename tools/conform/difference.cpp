#include "conform/difference.hpp"

#include <algorithm>
#include <cstdlib>
#include <ranges>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "arithmetic/colour.hpp"
#include "io/image_files.hpp"
#include "io/pictures.hpp"

namespace hmlfc::conform {

namespace {

Rgb pixel(const RgbImage& image, uint32_t x, uint32_t y) {
  const uint16_t* samples = image.samples.data() + (size_t{y} * image.width + x) * 3;
  return {samples[0], samples[1], samples[2]};
}

// Calls body(x, y) for each pixel of a block that lies in the view.
template <class Body>
void for_each_pixel(const RgbImage& image, uint32_t block_x, uint32_t block_y, unsigned block_size,
                    const Body& body) {
  const uint32_t x_end = std::min(image.width, (block_x + 1) * block_size);
  const uint32_t y_end = std::min(image.height, (block_y + 1) * block_size);
  for (uint32_t y = block_y * block_size; y < y_end; ++y) {
    for (uint32_t x = block_x * block_size; x < x_end; ++x) body(x, y);
  }
}

// The first wrong sample of the block and its planes.
void describe_block(const RgbImage& expected, const RgbImage& actual, unsigned block_size,
                    Difference& difference) {
  bool found = false;
  std::array<bool, kPlaneCount> wrong{};
  for_each_pixel(expected, difference.block_x, difference.block_y, block_size,
                 [&](uint32_t x, uint32_t y) {
                   const Rgb a = pixel(expected, x, y);
                   const Rgb b = pixel(actual, x, y);
                   if (a == b) return;
                   const YCoCg p = forward_colour(a);
                   const YCoCg q = forward_colour(b);
                   wrong[0] |= p.y != q.y;
                   wrong[1] |= p.co != q.co;
                   wrong[2] |= p.cg != q.cg;
                   if (found) return;
                   found = true;
                   difference.x = x;
                   difference.y = y;
                   difference.channel = a.r != b.r ? "R" : a.g != b.g ? "G" : "B";
                   difference.expected = a.r != b.r ? a.r : a.g != b.g ? a.g : a.b;
                   difference.actual = a.r != b.r ? b.r : a.g != b.g ? b.g : b.b;
                 });
  for (const Plane plane : kPlanes) {
    if (wrong[static_cast<size_t>(plane)]) difference.planes.push_back(plane);
  }
}

constexpr int32_t kGain = 16;

RgbImage to_8_bits(RgbImage image) {
  for (uint16_t& sample : image.samples) {
    sample = static_cast<uint16_t>(sample >> (image.depth - 8));
  }
  image.depth = 8;
  return image;
}

}  // namespace

BlockMap compare_blocks(const RgbImage& expected, const RgbImage& actual, unsigned block_size) {
  BlockMap map{(expected.width + block_size - 1) / block_size,
               (expected.height + block_size - 1) / block_size,
               {}};
  map.worst.reserve(size_t{map.columns} * map.rows);
  for (uint32_t by = 0; by < map.rows; ++by) {
    for (uint32_t bx = 0; bx < map.columns; ++bx) {
      int worst = 0;
      for_each_pixel(expected, bx, by, block_size, [&](uint32_t x, uint32_t y) {
        const Rgb a = pixel(expected, x, y);
        const Rgb b = pixel(actual, x, y);
        worst = std::max({worst, std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
      });
      map.worst.push_back(static_cast<uint16_t>(worst));
    }
  }
  return map;
}

std::optional<Difference> first_difference(const std::vector<RgbImage>& expected,
                                           const std::vector<RgbImage>& actual, uint32_t cols,
                                           unsigned block_size) {
  std::optional<Difference> difference;
  uint64_t blocks = 0;
  uint64_t wrong_blocks = 0;
  uint64_t wrong_views = 0;
  for (size_t i = 0; i < expected.size(); ++i) {
    const BlockMap map = compare_blocks(expected[i], actual[i], block_size);
    const auto is_wrong = [](uint16_t worst) { return worst != 0; };
    const auto wrong = std::ranges::count_if(map.worst, is_wrong);
    blocks += map.worst.size();
    wrong_blocks += static_cast<uint64_t>(wrong);
    wrong_views += wrong != 0;
    if (wrong == 0 || difference) continue;
    const auto at =
        static_cast<uint32_t>(std::ranges::find_if(map.worst, is_wrong) - map.worst.begin());
    difference.emplace();
    difference->view = {static_cast<uint32_t>(i) / cols, static_cast<uint32_t>(i) % cols};
    difference->block_x = at % map.columns;
    difference->block_y = at / map.columns;
    describe_block(expected[i], actual[i], block_size, *difference);
  }
  if (difference) {
    difference->blocks = blocks;
    difference->wrong_blocks = wrong_blocks;
    difference->wrong_views = wrong_views;
  }
  return difference;
}

std::string planes_text(const std::vector<Plane>& planes) {
  const auto names = std::views::transform(planes, plane_name);
  return fmt::format("plane{} {}", planes.size() == 1 ? "" : "s", fmt::join(names, ", "));
}

std::string to_string(const Difference& d) {
  return fmt::format(
      "view {},{} block {},{} (pixel {},{} {}): {} instead of {}; {}; {} of {} blocks in {} view{}",
      d.view.row, d.view.col, d.block_x, d.block_y, d.x, d.y, d.channel, d.actual, d.expected,
      planes_text(d.planes), d.wrong_blocks, d.blocks, d.wrong_views,
      d.wrong_views == 1 ? "" : "s");
}

io::IoResult<void> write_failure_pictures(const std::filesystem::path& folder,
                                          const RgbImage& expected, const RgbImage& actual) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return io::system_error(folder, "cannot be created", error.value());
  const auto difference = io::difference_picture(actual, expected, kGain);
  if (!difference) return tl::unexpected(difference.error());
  const RgbImage pictures[] = {to_8_bits(expected), to_8_bits(actual), *difference};
  for (size_t i = 0; i < std::size(kFailurePictures); ++i) {
    if (auto done = io::write_png(folder / kFailurePictures[i], pictures[i]); !done) return done;
  }
  return {};
}

}  // namespace hmlfc::conform
