// Conversions that keep the value.
#pragma once

#include <concepts>
#include <source_location>
#include <type_traits>
#include <utility>

#include "arithmetic/watch.hpp"

namespace hmlfc {

/// `x` in type To, which holds it. Where widths are watched, a value that it does not hold is
/// reported (note_lossy).
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
