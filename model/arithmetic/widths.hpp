// Intervals of samples (STR-7), conversions that keep the value, and the watch on what the
// quantities of the width tables (specification, section 11; docs/rendering.md, section 6) reach.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <source_location>
#include <string_view>
#include <utility>

#include <hmlfc/format.hpp>

#ifdef HMLFC_WATCH_WIDTHS
#include <width_rows.hpp>  // the width tables, generated from both documents
#endif

namespace hmlfc {

/// Samples lie in [lo, hi], residuals in [-bound, bound].
struct SampleRange {
  int32_t lo;
  int32_t hi;
  int32_t bound;  ///< M = hi - lo
};

/// The range of `plane` at `depth` in [8, 12].
///
/// Example: depth 8 gives {0, 255, 255} for Y and {-255, 255, 510} for Co and Cg.
constexpr SampleRange sample_range(Plane plane, int depth) {
  const int32_t hi = (int32_t{1} << depth) - 1;
  const int32_t lo = plane == Plane::kY ? 0 : -hi;
  return {lo, hi, hi - lo};
}

/// Whether this build watches widths (./run stress). In all others watch() leaves no code.
#ifdef HMLFC_WATCH_WIDTHS
inline constexpr bool kWidthsWatched = true;
#else
inline constexpr bool kWidthsWatched = false;
#endif

/// A row of a width table, named by its quantity. Where widths are watched, a name that no row has
/// does not compile; elsewhere tests/spec/width_probes.py finds it.
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
  bool chroma = false;  ///< false for rows that do not distinguish planes
  int64_t value = 0;
  std::source_location where;
};

/// Receive what is watched, from several threads at once; a build with HMLFC_WATCH_WIDTHS defines
/// them. note_lossy: a conversion at `where` did not keep its value.
void note_value(const WatchedValue& watched);
void note_lossy(const std::source_location& where);

/// Watches `value` of a plane whose samples lie in `range`.
constexpr void watch(Width width, int64_t value, const SampleRange& range,
                     const std::source_location& where = std::source_location::current()) {
  if constexpr (kWidthsWatched) {
    if (std::is_constant_evaluated()) return;
    const auto depth = static_cast<int>(std::bit_width(static_cast<uint32_t>(range.hi)));
    note_value({width.row(), depth, range.lo < 0, value, where});
  }
}

/// The same for a row that does not distinguish planes; depth in [8, 12], or left out for a row
/// that does not depend on it.
constexpr void watch(Width width, int64_t value, int depth = 8,
                     const std::source_location& where = std::source_location::current()) {
  if constexpr (kWidthsWatched) {
    if (!std::is_constant_evaluated()) note_value({width.row(), depth, false, value, where});
  }
}

/// `x` in type To, which holds it; where widths are watched, a loss is reported (note_lossy).
///
/// Example: narrow<int16_t>(-510).
#ifdef HMLFC_WATCH_WIDTHS
template <std::integral To, std::integral From>
constexpr To narrow(From x, const std::source_location& where = std::source_location::current()) {
  const To y = static_cast<To>(x);
  if (!std::is_constant_evaluated() && std::cmp_not_equal(x, y)) note_lossy(where);
  return y;
}
#else
template <std::integral To, std::integral From>
constexpr To narrow(From x) {
  return static_cast<To>(x);
}
#endif

}  // namespace hmlfc
