// Records what watched quantities reach (arithmetic/widths.hpp) and compares it with the width
// tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "arithmetic/widths.hpp"
#include "vectors/json.hpp"

namespace hmlfc::stress {

inline constexpr size_t kRows = std::size(kWidthRows);
inline constexpr int kMinDepth = 8;
inline constexpr size_t kDepths = 5;

/// Smallest and largest value that occurred; none where min > max.
struct Reached {
  int64_t min = INT64_MAX;
  int64_t max = INT64_MIN;

  bool any() const { return min <= max; }
  void add(const Reached& other);
};

/// A row of a table at one depth, of Y or of Co and Cg.
struct Place {
  size_t row = 0;
  size_t depth = 0;  ///< depth - 8: [0, 4]
  size_t plane = 0;  ///< 0: Y, 1: Co and Cg
};

/// The values that all rows reached.
struct Ranges {
  std::array<std::array<std::array<Reached, 2>, kDepths>, kRows> rows;

  Reached& at(const Place& place) { return rows[place.row][place.depth][place.plane]; }
  const Reached& at(const Place& place) const { return rows[place.row][place.depth][place.plane]; }
};

/// Every place of a table that has an interval of its own.
std::vector<Place> places(WidthTable table);

/// The interval of the table.
WidthInterval limits_of(const Place& place);

/// Returns what was reached since the last call. No thread may be watching meanwhile.
Ranges take_ranges();

/// The first violation since the last call, as text: the quantity, its value, the interval and the
/// line of the model; or the line of a conversion that lost its value.
std::optional<std::string> take_violation();

/// Keeps what the rows of a table reached over a whole run, and by which stream.
class WidthReport {
 public:
  explicit WidthReport(WidthTable table) : places_(places(table)), records_(places_.size()) {}

  /// Takes in what `name` reached.
  void add(const std::string& name, const Ranges& ranges);

  /// Each place of the table: its proved interval, what was reached, and which name reached it
  /// first.
  vectors::Json rows() const;

 private:
  struct Record {
    Reached reached;
    std::string min_by;
    std::string max_by;
  };

  std::vector<Place> places_;
  std::vector<Record> records_;
};

}  // namespace hmlfc::stress
