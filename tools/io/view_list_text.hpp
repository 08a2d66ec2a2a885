// The sentences about names of views: what was understood, and what is wrong with them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/name_grid.hpp"

namespace hmlfc::io {

/// The name with its extension.
std::string shown_name(const NamedPicture& picture);

/// "a, b, c and 2 more".
std::string name_some(const std::vector<std::string>& names);

/// "row 3, column 4".
std::string describe_place(GridPosition at);

/// "1 to 9", "2 to 6 in steps of 2", "2 to 9 with gaps" or "7".
std::string describe_values(const NumberColumn& column);

/// "27x27 views from numbers 1 and 2 of the names; 3 to 6 vary with them"; empty where that goes
/// without saying.
std::string describe_reading(const std::vector<NamedPicture>& views, const GridReading& reading);

/// A pattern of the name of `picture`: 'left_{row}_{col}' with its last two numbers, * for others.
std::string open_pattern(const NamedPicture& picture);

/// "numbers 1 and 2 or 1 and 4 of the names ... choose by --names ...".
std::string describe_choice(const std::vector<NamedPicture>& views,
                            const std::vector<GridReading>& readings);

/// Why no two of `columns` are row and column.
std::string describe_no_grid(const std::vector<NamedPicture>& views,
                             const std::vector<NumberColumn>& columns);

/// "1 of the 20 views of a 4x5 grid is missing: row 2, column 3 (out_02_03.png)". With `gaps`, rows
/// and columns are those that there are, else all in regular steps; `by_pattern`: what other text
/// the names have is not known.
std::string describe_missing(const std::vector<NamedPicture>& views, const GridReading& reading,
                             bool gaps, bool by_pattern);

/// The name of `picture` with `values` in place of some of its numbers, and * for others that vary:
/// "cam_03_*.png"; with as many digits as the names have.
std::string name_with(const std::vector<NamedPicture>& views,
                      const std::vector<std::pair<size_t, int64_t>>& values);

/// What is wrong with the number of `pictures`, which should be the views of `grid`; what is
/// missing is named, as far as `counter`, the number that is another in each, or their order tells
/// it. `from_0`: the first number that there should be is 0.
std::string describe_count(const std::vector<NamedPicture>& pictures,
                           const std::optional<NumberColumn>& counter, GridShape grid,
                           FrameOrder order, bool from_0);

/// "3x3 views in the order of number 1 of the names (1 to 9), row by row".
std::string describe_order(const std::vector<NamedPicture>& sorted,
                           const std::optional<NumberColumn>& counter, GridShape grid,
                           FrameOrder order);

}  // namespace hmlfc::io
