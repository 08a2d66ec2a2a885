#include "encoder/part_grid.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "encoder/plane_targets.hpp"

namespace hmlfc {
namespace {

// Bytes that an encoder holds next to images: buffers of threads and libraries.
constexpr uint64_t kProgramBytes = 24u << 20;
constexpr uint64_t kThreadBytes = 4u << 20;

// Bytes of one image in the forms in which it is held.
struct ImageBytes {
  uint64_t view = 0;       // as it is fetched
  uint64_t planes = 0;     // in whole blocks
  uint64_t reference = 0;  // with padding
  uint64_t luma = 0;       // samples of plane Y with padding
};

ImageBytes image_bytes(const StreamHeader& header, const Geometry& geometry) {
  ImageBytes bytes;
  bytes.view = uint64_t{header.width} * header.height * 3 * sizeof(uint16_t);
  const bool main = header.profile == Profile::kMain;
  const uint64_t pad = 2 * (static_cast<uint64_t>(header.window) + (main ? 40 : 10));
  for (const Plane plane : kPlanes) {
    const PlaneShape& shape = geometry.plane(plane);
    const uint64_t block = geometry.block_size();
    const uint64_t padded = (shape.width + pad) * (shape.height + pad);
    bytes.planes += shape.blocks_x * block * shape.blocks_y * block * sizeof(int16_t);
    bytes.reference += padded * sizeof(int16_t);
    bytes.luma = std::max(bytes.luma, padded);
  }
  return bytes;
}

// Returns the bytes that one thread works with: an image being coded, or a key image with the
// images that refine it.
uint64_t work_bytes(const StreamHeader& header, Preset preset, const ImageBytes& image) {
  const bool refines = header.has(Feature::kMotionTiles);
  const uint64_t targets = refines ? effort_of(preset).disparity_images : 0;
  constexpr uint64_t kWorkOfSample = 40;  // JPEG 2000 and the sums of a refinement
  return (targets + 5) * image.planes + kWorkOfSample * image.luma + 3 * image.view + kThreadBytes;
}

// Bytes that coding `part` may take on `threads` threads.
uint64_t part_bytes(const StreamHeader& header, const Geometry& geometry, Preset preset,
                    const EncodePart& part, int threads) {
  const ImageBytes image = image_bytes(header, geometry);
  uint64_t tree = 0;
  uint64_t references = 0;
  for (size_t l = 0; l < part.levels.size(); ++l) {
    const LevelPart& level = part.levels[l];
    tree += level.originals.size() * image.planes;
    if (!level.predicts) continue;
    const uint64_t originals = geometry.level(static_cast<int>(l)).keyed ? image.planes : 0;
    references = std::max(references, level.references.size() * (image.reference + originals) +
                                          level.context.size() * image.reference);
  }
  return kProgramBytes + tree + references +
         static_cast<uint64_t>(threads) * work_bytes(header, preset, image);
}

// Where parts may end, in rows or columns of views: a group of level 0, or a cluster of the tree.
std::vector<uint32_t> unit_ends(const Geometry& geometry, bool rows) {
  constexpr int kLevelsOfUnit = 3;
  const int level = std::min(geometry.top(), kLevelsOfUnit);
  const uint32_t count = rows ? geometry.level(0).rows : geometry.level(0).cols;
  std::vector<uint32_t> ends;
  for (uint32_t at = 0; at < count; at = ends.back()) {
    const ImagePos view = rows ? ImagePos{at, 0} : ImagePos{0, at};
    const ImageRange unit = level > 0
                                ? geometry.descendants(geometry.ancestor(view, 0, level), level, 0)
                                : geometry.group_images(0, view);
    ends.push_back(rows ? unit.row1 : unit.col1);
  }
  return ends;
}

std::vector<uint32_t> every_view(uint32_t count) {
  std::vector<uint32_t> ends(count);
  std::iota(ends.begin(), ends.end(), 1u);
  return ends;
}

// Every `step`-th of `ends`, and the last.
std::vector<uint32_t> every(const std::vector<uint32_t>& ends, size_t step) {
  std::vector<uint32_t> some;
  for (size_t i = step; i < ends.size(); i += step) some.push_back(ends[i - 1]);
  some.push_back(ends.back());
  return some;
}

// Of the largest part.
uint64_t largest_bytes(const StreamHeader& header, const Geometry& geometry, Preset preset,
                       const PartGrid& grid, int threads) {
  uint64_t most = 0;
  for (size_t part = 0; part < grid.count(); ++part) {
    const EncodePart images =
        part_of_views(geometry, views_of_part(grid, part), [](int, ImagePos) { return false; });
    most = std::max(most, part_bytes(header, geometry, preset, images, threads));
  }
  return most;
}

}  // namespace

ImageRange views_of_part(const PartGrid& grid, size_t part) {
  const size_t row = part / grid.col_ends.size();
  const size_t col = part % grid.col_ends.size();
  return {row > 0 ? grid.row_ends[row - 1] : 0, grid.row_ends[row],
          col > 0 ? grid.col_ends[col - 1] : 0, grid.col_ends[col]};
}

bool covers(const PartGrid& grid, const StreamHeader& header) {
  const auto line = [](const std::vector<uint32_t>& ends, uint32_t count) {
    return !ends.empty() && ends.front() > 0 && ends.back() == count &&
           std::ranges::adjacent_find(ends, std::greater_equal<>()) == ends.end();
  };
  return line(grid.row_ends, header.rows) && line(grid.col_ends, header.cols);
}

std::optional<FittingParts> fitting_parts(const StreamHeader& header, Preset preset,
                                          uint64_t memory, int threads, uint64_t& least) {
  const Geometry geometry(header);
  least = ~uint64_t{0};
  // Halves parts of units until they take at most `memory`; none where single units take more.
  const auto fit = [&](const PartGrid& units, int count) -> std::optional<FittingParts> {
    size_t rows = units.row_ends.size();
    size_t cols = units.col_ends.size();
    for (;;) {
      FittingParts parts{{every(units.row_ends, rows), every(units.col_ends, cols)}, count, 0};
      parts.bytes = largest_bytes(header, geometry, preset, parts.grid, count);
      least = std::min(least, parts.bytes);
      if (parts.bytes <= memory) return parts;
      if (rows == 1 && cols == 1) return std::nullopt;
      (rows >= cols ? rows : cols) = (std::max(rows, cols) + 1) / 2;
    }
  };
  const PartGrid units{unit_ends(geometry, true), unit_ends(geometry, false)};
  for (int count = threads; count >= 1; --count) {
    if (auto found = fit(units, count)) return found;
  }
  return fit({every_view(header.rows), every_view(header.cols)}, 1);
}

PartGrid small_parts(const StreamHeader& header) {
  const Geometry geometry(header);
  const size_t step = geometry.top() > 0 ? 1 : 2;
  return {every(unit_ends(geometry, true), step), every(unit_ends(geometry, false), step)};
}

}  // namespace hmlfc
