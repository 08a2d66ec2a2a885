#include "io/view_name.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <regex>

#include <fmt/format.h>

namespace hmlfc::io {

namespace {

constexpr std::string_view kCameraPrefix = "input_Cam";
constexpr size_t kMostLetters = 512;  // of a file's name: the library takes stack for each

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Removes the digits at the front of `text` and returns them without leading zeros.
std::string_view take_number(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  std::string_view digits = text.substr(0, static_cast<size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

/// The number nearest to `text`, which has a sign or none; infinite beyond all numbers.
double decimal_value(std::string text) {
  if (text.front() == '+') text.erase(0, 1);
  double value = std::numeric_limits<double>::infinity();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::strong_ordering natural_order(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view left = take_number(a);
      const std::string_view right = take_number(b);
      if (left.size() != right.size()) return left.size() <=> right.size();
      if (const auto order = left <=> right; order != 0) return order;
      continue;
    }
    const auto left = static_cast<unsigned char>(a.front());
    const auto right = static_cast<unsigned char>(b.front());
    if (left != right) return left <=> right;
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.size() <=> b.size();
}

std::optional<CameraPlace> parse_camera_place(std::string_view stem) {
  static const std::regex form(
      R"(out_[^_]*_[^_]*_([-+]?(?:\d+\.?\d*|\.\d+))_([-+]?(?:\d+\.?\d*|\.\d+))_?)");
  const std::string name(stem.substr(0, kMostLetters));
  std::smatch parts;
  if (!std::regex_match(name, parts, form)) return std::nullopt;
  const CameraPlace place{decimal_value(parts[1]), decimal_value(parts[2])};
  if (!std::isfinite(place.y) || !std::isfinite(place.x)) return std::nullopt;
  return place;
}

std::optional<uint32_t> parse_camera_name(std::string_view stem) {
  if (!stem.starts_with(kCameraPrefix)) return std::nullopt;
  const std::string_view digits = stem.substr(kCameraPrefix.size());
  if (digits.size() > 8) return std::nullopt;
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

std::string view_stem(uint32_t row, uint32_t col, uint32_t rows, uint32_t cols) {
  const size_t digits = std::max<size_t>(2, std::to_string(std::max(rows, cols) - 1).size());
  return fmt::format("{:0{}}_{:0{}}", row, digits, col, digits);
}

std::string view_file_name(uint32_t row, uint32_t col, uint32_t rows, uint32_t cols) {
  return view_stem(row, col, rows, cols) + ".png";
}

std::string camera_file_name(uint32_t index) {
  return fmt::format("{}{:03}.png", kCameraPrefix, index);
}

std::string pleno_file_name(uint32_t row, uint32_t col) {
  return fmt::format("{:03}_{:03}.ppm", col, row);
}

}  // namespace hmlfc::io
