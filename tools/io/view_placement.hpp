// From named files to a complete grid, or to the sentence that says what is wrong with them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/io_error.hpp"
#include "io/view_list.hpp"

namespace hmlfc::io {

/// A file whose name says where it belongs: at position `index` = row * columns + column.
struct PlacedView {
  uint64_t index = 0;
  std::filesystem::path file;
};

/// How the messages name a place: "row 3, column 4".
std::string describe_place(uint64_t index, uint32_t cols);

/// Up to three of `names`, then how many more there are: "a, b, c and 2 more".
std::string name_some(const std::vector<std::string>& names);

/// The list in which each index in [0, rows * cols - 1] has exactly one of `views`, given in any
/// order, each with an index in that interval. Errors: an index is missing or double.
IoResult<ViewList> place_all(const std::filesystem::path& folder, GridShape grid,
                             std::vector<PlacedView> views);

/// The list of `files`, in natural order, row by row. Errors: two files of the same number, too few
/// (with the first jump in the numbering, if there is one) or too many.
IoResult<ViewList> place_in_order(const std::filesystem::path& folder, GridShape grid,
                                  std::vector<std::filesystem::path> files);

}  // namespace hmlfc::io
