// Which two numbers in the names of pictures are row and column.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/grid.hpp"
#include "io/name_numbers.hpp"

namespace hmlfc::io {

/// A picture, the name by which it is understood, and the numbers of that.
struct NamedPicture {
  std::filesystem::path file;
  std::string name;
  std::vector<NameNumber> numbers;
};

/// One number of the names of many pictures, an integer in all of them.
struct NumberColumn {
  size_t number = 0;            ///< which of the numbers, from 0
  std::vector<int64_t> values;  ///< that it has, ascending
  std::vector<uint32_t> ranks;  ///< of each picture, the place of its value among them

  /// The greatest common divisor of the differences; 1 for one value.
  int64_t step() const;

  /// How many values from the first to the last there are in steps of step().
  uint64_t extent() const;

  /// Whether it has all of these.
  bool is_regular() const { return extent() == values.size(); }
};

/// The numbers that are integers in all `pictures`; of those that vary the first 16. None where
/// some have more numbers than others. One that says the same as another, in other values, is left
/// out: the one that counts in steps from 0 or 1 stays.
std::vector<NumberColumn> number_columns(std::span<const NamedPicture> pictures);

/// Numbers 0 and 1, which are integers.
std::array<NumberColumn, 2> position_columns(std::span<const NamedPicture> pictures);

/// Two numbers as row and column.
struct GridReading {
  const NumberColumn* row = nullptr;
  const NumberColumn* col = nullptr;

  uint64_t rows() const { return row->values.size(); }
  uint64_t cols() const { return col->values.size(); }
  size_t place(size_t picture) const {
    return row->ranks[picture] * col->values.size() + col->ranks[picture];
  }
};

/// Whether each place in the grid of `reading` has one of as many `pictures`; without `grid`, which
/// else it must have, the values are regular.
bool is_full(const GridReading& reading, size_t pictures, std::optional<GridShape> grid);

/// The pairs of `columns` of which each place in a full grid has one of `pictures`; the first
/// number is the row, unless letters before both say otherwise, as in x3_y4. Without `grid` the
/// values have to be regular; of several pairs those remain that count from 0 or 1.
std::vector<GridReading> full_grids(std::span<const NamedPicture> pictures,
                                    const std::vector<NumberColumn>& columns,
                                    std::optional<GridShape> grid);

/// The pair that comes closest to a full grid: no place has two pictures, and at least about half
/// of the places have one.
std::optional<GridReading> nearest_grid(std::span<const NamedPicture> pictures,
                                        const std::vector<NumberColumn>& columns,
                                        std::optional<GridShape> grid);

}  // namespace hmlfc::io
