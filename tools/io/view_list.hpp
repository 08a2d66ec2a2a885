// The views of a light field as files of one folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/grid.hpp"
#include "io/io_error.hpp"

namespace hmlfc::io {

/// One file per view of a complete grid.
struct ViewList {
  uint32_t rows = 0;
  uint32_t cols = 0;
  std::vector<std::filesystem::path> files = {};  ///< rows * cols paths, row-major
  std::filesystem::path folder = {};              ///< in which they were looked for
  std::vector<std::string> notes = {};            ///< for the user: how names were understood
  size_t whole = 0;                               ///< views of the grid of which these are a part
  std::vector<size_t> numbers = {};               ///< their numbers in it, row-major
};

/// What the user says of the names of views, instead of what list_views() would find.
struct ViewNaming {
  std::optional<GridShape> grid = std::nullopt;
  std::string pattern = {};                        ///< as NamePattern; empty: none
  std::optional<FrameOrder> order = std::nullopt;  ///< the names are a sequence in this order
  bool pattern_is_for_others = false;              ///< where no name matches, there is none
};

/// Whether `file` is named *.png, .ppm, .pgm, .pnm, .jpg, .jpeg, .jpe, .jfif, .tif, .tiff or .webp
/// (in any case), without a dot in front.
bool is_picture_name(const std::filesystem::path& file);

/// Whether a file's extension is that of a video which hmlfc does not read: *.mp4, *.mov and such.
bool is_other_video(const std::filesystem::path& file);

/// Finds the views in `folder`: files of which is_picture_name() is true. Where there are none, or
/// hardly any, those in its subfolders are taken, with names as ROW/COL.
///
/// Names of one form, which differ in their numbers alone, are those of views; others are ignored,
/// with a note, where these make a full grid. The grid is found from
/// - two numbers of which each pair of values is there once (full_grids());
/// - the numbers of a sequence, where `naming` has a grid; for input_CamNNN it may be that of a
///   parameters.cfg in the folder, or a square;
/// - the sorted order of any other names, where `naming` has a grid.
/// With a grid, views may be a subset of the rows and columns of a larger one, with gaps. A note
/// says what was understood, unless names have row and column, counted from 0, and no more numbers.
///
/// Errors: no such folder, no pictures, several ways to understand them, no grid, or a view that is
/// missing or twice there; the message names files, row and column, and the option that helps.
IoResult<ViewList> list_views(const std::filesystem::path& folder, const ViewNaming& naming = {});

/// The numbers first, first + step, first + 2 step, ... up to `last`, counted from 0.
struct IndexRange {
  uint32_t first = 0;  ///< [0, last]
  uint32_t last = 0;
  uint32_t step = 1;  ///< at least 1
};

/// Rows and columns of a grid: the views where they cross.
struct ViewPart {
  IndexRange rows;
  IndexRange cols;
};

/// The views of `part` among `views`, which list_views() found in `folder`; rows and columns are
/// numbered anew, from 0 and without gaps. Error: a range ends beyond the grid.
IoResult<ViewList> part_of(const std::filesystem::path& folder, const ViewList& views,
                           const ViewPart& part);

}  // namespace hmlfc::io
