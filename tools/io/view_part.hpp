// A part of a grid of views.
#pragma once

#include <cstdint>
#include <filesystem>

#include "io/io_error.hpp"
#include "io/view_list.hpp"

namespace hmlfc::io {

/// The numbers first, first + step, first + 2 step, ... up to `last`, counted from 0.
struct IndexRange {
  uint32_t first = 0;  ///< [0, last]
  uint32_t last = 0;
  uint32_t step = 1;  ///< at least 1

  friend bool operator==(const IndexRange&, const IndexRange&) = default;
};

/// Rows and columns of a grid: the views where they cross.
struct ViewPart {
  IndexRange rows;
  IndexRange cols;

  friend bool operator==(const ViewPart&, const ViewPart&) = default;
};

/// The views of `part` among `views`, which list_views() found in `folder`; rows and columns are
/// numbered anew, from 0 and without gaps. Error: a range ends beyond the grid.
IoResult<ViewList> part_of(const std::filesystem::path& folder, const ViewList& views,
                           const ViewPart& part);

}  // namespace hmlfc::io
