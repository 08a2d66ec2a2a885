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

/// Whether `file` is named *.png, .ppm, .pgm, .pnm, .jpg, .jpeg, .jpe, .jfif, .tif, .tiff or .webp
/// (in any case), without a dot in front.
bool is_picture_name(const std::filesystem::path& file);

/// Finds the views in `folder`: all files of which is_picture_name() is true; other files are
/// ignored, subfolders are not searched.
/// The form of most names decides:
/// - row and column in the name (see parse_grid_name); without `grid` the grid is their greatest
///   values + 1; with it the names may be a subset of a larger grid, `grid`.rows of its rows and
///   `grid`.cols of its columns, which are numbered anew from 0;
/// - input_CamNNN, NNN = row * columns + column; without `grid` it is that of a parameters.cfg in
///   the folder, else a square grid; with it
///   the names may be a subset of as many views as `grid` has, taken in order;
/// - anything else, in natural order row by row; `grid` is needed.
///
/// Errors: no such folder, no images, unknown grid, `grid` contradicts the names, or a view that is
/// missing, duplicate or extra; the message names its row, column and file.
IoResult<ViewList> list_views(const std::filesystem::path& folder,
                              std::optional<GridShape> grid = std::nullopt);

}  // namespace hmlfc::io
