// A grid of views, and the orders in which its views follow each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace hmlfc::io {

inline constexpr uint32_t kMaxGridSide = 4096;

/// A grid of views.
struct GridShape {
  uint32_t rows = 0;  ///< [1, 4096]
  uint32_t cols = 0;  ///< [1, 4096]

  friend bool operator==(const GridShape&, const GridShape&) = default;
};

/// "9x17".
inline std::string describe(GridShape grid) {
  return std::to_string(grid.rows) + "x" + std::to_string(grid.cols);
}

/// A position in the grid of views.
struct GridPosition {
  uint32_t row = 0;  ///< [0, 4095]
  uint32_t col = 0;  ///< [0, 4095]

  friend bool operator==(const GridPosition&, const GridPosition&) = default;
};

/// In which order views follow each other, as frames of a video or as pictures of a sequence.
enum class FrameOrder : uint8_t {
  kRaster,             ///< row by row, each from the left
  kSerpentine,         ///< likewise, but odd rows from the right
  kColumns,            ///< column by column, each from the top
  kColumnsSerpentine,  ///< likewise, but odd columns from the bottom
};

/// Their words, in files and options.
inline constexpr std::array<std::pair<std::string_view, FrameOrder>, 4> kFrameOrders{
    {{"raster", FrameOrder::kRaster},
     {"serpentine", FrameOrder::kSerpentine},
     {"columns", FrameOrder::kColumns},
     {"columns-serpentine", FrameOrder::kColumnsSerpentine}}};

/// The view that frame `index` in [0, rows * cols - 1] shows.
constexpr GridPosition view_of_frame(size_t index, GridShape grid, FrameOrder order) {
  const bool upright = order == FrameOrder::kColumns || order == FrameOrder::kColumnsSerpentine;
  const bool turns = order == FrameOrder::kSerpentine || order == FrameOrder::kColumnsSerpentine;
  const uint32_t length = upright ? grid.rows : grid.cols;
  const auto line = static_cast<uint32_t>(index / length);
  const auto along = static_cast<uint32_t>(index % length);
  const uint32_t at = turns && line % 2 == 1 ? length - 1 - along : along;
  return upright ? GridPosition{at, line} : GridPosition{line, at};
}

/// The frame that shows a view: view_of_frame(frame_of_view(v, ...), ...) == v.
constexpr size_t frame_of_view(GridPosition view, GridShape grid, FrameOrder order) {
  const bool upright = order == FrameOrder::kColumns || order == FrameOrder::kColumnsSerpentine;
  const size_t length = upright ? grid.rows : grid.cols;
  const size_t index = upright ? view.col * length + view.row : view.row * length + view.col;
  const GridPosition turned = view_of_frame(index, grid, order);  // an odd line is turned twice
  return upright ? view.col * length + turned.row : view.row * length + turned.col;
}

}  // namespace hmlfc::io
