// What watched quantities reached (arithmetic/widths.hpp), against the width tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "arithmetic/widths.hpp"

namespace hmlfc::stress {

inline constexpr size_t kRows = std::size(kWidthRows);
inline constexpr int kLeastDepth = 8;
inline constexpr size_t kDepths = 5;

/// Least and greatest value that occurred; none where least > greatest.
struct Reached {
  int64_t least = INT64_MAX;
  int64_t greatest = INT64_MIN;

  bool any() const { return least <= greatest; }
  void add(const Reached& other);
};

/// The same for a row at one depth, of Y or of Co and Cg.
struct Place {
  size_t row = 0;
  size_t depth = 0;  ///< depth - 8: [0, 4]
  size_t plane = 0;  ///< 0: Y, 1: Co and Cg
};

/// What all rows reached.
struct Ranges {
  std::array<std::array<std::array<Reached, 2>, kDepths>, kRows> rows;

  Reached& at(const Place& place) { return rows[place.row][place.depth][place.plane]; }
  const Reached& at(const Place& place) const { return rows[place.row][place.depth][place.plane]; }
};

/// The places of all rows of a table that it tells apart.
std::vector<Place> places(WidthTable table);

/// The table's interval.
WidthInterval limits_of(const Place& place);

/// Row `quantity` counts as narrower by one at both ends from now on: a fault to find. False for a
/// name that is no row.
bool plant_narrow(const std::string& quantity);

/// What was reached since the last call, and forgets it. Nobody may be watching meanwhile.
Ranges take_ranges();

/// The first violation since the last call, for people: the quantity, its value, the interval and
/// the line of the model; or the line of a conversion that lost its value.
std::optional<std::string> take_violation();

}  // namespace hmlfc::stress
