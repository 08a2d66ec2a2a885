// What the quantities of the width tables (specification, section 11; docs/rendering.md, section 6)
// reach, for builds that watch them (HMLFC_WATCH_WIDTHS, ./run stress). In all other builds nothing
// here leaves any code.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <source_location>
#include <string_view>
#include <type_traits>

#include "arithmetic/sample_range.hpp"

#ifdef HMLFC_WATCH_WIDTHS
#include <width_rows.hpp>  // the width tables, generated from both documents
#endif

namespace hmlfc {

#ifdef HMLFC_WATCH_WIDTHS
inline constexpr bool kWidthsWatched = true;
#else
inline constexpr bool kWidthsWatched = false;
#endif

/// A row of a width table by its quantity. Where widths are watched, a name that is no row's does
/// not compile; elsewhere tests/spec/width_probes.py finds it.
class Width {
 public:
  consteval Width(const char* quantity) : row_(row_of(quantity)) {}
  constexpr size_t row() const { return row_; }

 private:
  static consteval size_t row_of([[maybe_unused]] std::string_view quantity) {
#ifdef HMLFC_WATCH_WIDTHS
    size_t row = 0;
    while (kWidthRows[row].quantity != quantity) ++row;
    return row;
#else
    return 0;
#endif
  }

  size_t row_;
};

/// A value of a row at one depth, of Y or of Co and Cg, and where it was computed.
struct WatchedValue {
  size_t row = 0;
  int depth = 8;        ///< [8, 12]; 8 for rows that do not depend on it
  bool chroma = false;  ///< false for rows that do not tell planes apart
  int64_t value = 0;
  std::source_location where;
};

/// Take what is watched, from several threads at once; whoever builds with HMLFC_WATCH_WIDTHS
/// defines them. note_lossy: a conversion at `where` did not keep its value.
void note_value(const WatchedValue& watched);
void note_lossy(const std::source_location& where);

/// `value` of a plane whose samples lie in `range`.
constexpr void watch(Width width, int64_t value, const SampleRange& range,
                     const std::source_location& where = std::source_location::current()) {
  if constexpr (kWidthsWatched) {
    if (std::is_constant_evaluated()) return;
    const auto depth = static_cast<int>(std::bit_width(static_cast<uint32_t>(range.hi)));
    note_value({width.row(), depth, range.lo < 0, value, where});
  }
}

/// The same where planes are not told apart; depth in [8, 12].
constexpr void watch(Width width, int64_t value, int depth,
                     const std::source_location& where = std::source_location::current()) {
  if constexpr (kWidthsWatched) {
    if (!std::is_constant_evaluated()) note_value({width.row(), depth, false, value, where});
  }
}

/// The same of a row that does not depend on the depth.
constexpr void watch(Width width, int64_t value,
                     const std::source_location& where = std::source_location::current()) {
  watch(width, value, 8, where);
}

}  // namespace hmlfc
