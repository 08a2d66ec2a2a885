// The order in which people number files: "view2" before "view10".
#pragma once

#include <compare>
#include <string_view>

namespace hmlfc::io {

/// Compares text byte by byte and each run of decimal digits, of any length, as one number.
/// Equal for names that differ only in leading zeros: natural_order("a7", "a007") == 0.
std::strong_ordering natural_order(std::string_view a, std::string_view b);

}  // namespace hmlfc::io
