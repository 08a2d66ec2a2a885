// Numbers in arguments, read strictly: "4x4", "3,5", plain decimal numbers.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace hmlfc::terminal {

/// A decimal integer in the range of T: digits alone, after a minus sign where T is signed. "010"
/// is ten.
template <std::integral T>
std::optional<T> parse_integer(std::string_view text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || last != end) return std::nullopt;
  return value;
}

/// N numbers separated by `separator`: parse_numbers<2>("16x9", 'x') = {16, 9}.
template <size_t N>
std::optional<std::array<uint32_t, N>> parse_numbers(std::string_view text, char separator) {
  std::array<uint32_t, N> numbers{};
  for (size_t i = 0; i < N; ++i) {
    const size_t end = i + 1 < N ? text.find(separator) : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    const auto number = parse_integer<uint32_t>(text.substr(0, end));
    if (!number) return std::nullopt;
    numbers[i] = *number;
    if (i + 1 < N) text.remove_prefix(end + 1);
  }
  return numbers;
}

/// From `least` to `most` finite decimal numbers separated by commas: "7.5,3,-2".
inline std::optional<std::vector<double>> parse_decimals(std::string_view text, size_t least,
                                                         size_t most) {
  std::vector<double> numbers;
  while (true) {
    const size_t comma = std::min(text.find(','), text.size());
    double number = 0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + comma, number);
    if (error != std::errc{} || last != text.data() + comma || !std::isfinite(number)) {
      return std::nullopt;
    }
    numbers.push_back(number);
    if (comma == text.size()) break;
    text.remove_prefix(comma + 1);
  }
  if (numbers.size() < least || numbers.size() > most) return std::nullopt;
  return numbers;
}

}  // namespace hmlfc::terminal
