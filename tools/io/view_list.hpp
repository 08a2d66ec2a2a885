// The views of a light field as files of one folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "io/io_error.hpp"

namespace hmlfc::io {

/// A grid of views.
struct GridShape {
  uint32_t rows = 0;  ///< [1, 4096]
  uint32_t cols = 0;  ///< [1, 4096]
};

/// One file per view of a complete grid.
struct ViewList {
  uint32_t rows = 0;
  uint32_t cols = 0;
  std::vector<std::filesystem::path> files;  ///< rows * cols paths, row-major
};

/// Finds the views in `folder`: all files named *.png, .ppm, .pgm, .pnm, .jpg or .jpeg (in any
/// case) that do not begin with a point; other files are ignored, folders below are not entered.
/// Forms of names, told by what most of the files have:
/// - row and column in the name (see parse_grid_name); the grid is their greatest values + 1;
/// - input_CamNNN, NNN = row * columns + column; without `grid` a square grid is assumed;
/// - anything else, in natural order row by row; `grid` is needed.
///
/// Errors: no such folder, no pictures, no way to tell the grid, `grid` disagrees with the names,
/// or a view that is missing, double or too many; the message names its row, column and file.
IoResult<ViewList> list_views(const std::filesystem::path& folder,
                              std::optional<GridShape> grid = std::nullopt);

}  // namespace hmlfc::io
