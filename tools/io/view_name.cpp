#include "io/view_name.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace hmlfc::io {

namespace {

constexpr std::string_view kCameraPrefix = "input_Cam";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Removes the digits at the front of `text` and returns them without leading zeros.
std::string_view take_number(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  std::string_view digits = text.substr(0, static_cast<size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

/// A number of 1 to `max_digits` digits and nothing else.
std::optional<uint32_t> parse_digits(std::string_view text, size_t max_digits) {
  if (text.empty() || text.size() > max_digits || !std::ranges::all_of(text, is_digit)) {
    return std::nullopt;
  }
  uint32_t value = 0;
  for (const char c : text) value = value * 10 + static_cast<uint32_t>(c - '0');
  return value;
}

/// [+-]digits[.digits], or one of the two digit strings absent.
bool is_decimal(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  const auto points = std::ranges::count(text, '.');
  const auto digits = std::ranges::count_if(text, is_digit);
  return points <= 1 && digits >= 1 && static_cast<size_t>(points + digits) == text.size();
}

/// The number nearest to `text`, for which is_decimal() is true; infinite beyond all numbers.
double decimal_value(std::string_view text) {
  if (text.front() == '+') text.remove_prefix(1);
  double value = std::numeric_limits<double>::infinity();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::vector<std::string_view> split_at_underscores(std::string_view text) {
  std::vector<std::string_view> parts;
  for (size_t end = text.find('_'); end != text.npos; end = text.find('_')) {
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

/// out_RR_CC_Y_X with an optional trailing underscore.
bool has_camera_position(const std::vector<std::string_view>& parts) {
  const bool right_count = parts.size() == 5 || (parts.size() == 6 && parts[5].empty());
  return right_count && parts[0] == "out" && is_decimal(parts[3]) && is_decimal(parts[4]);
}

std::string padded(uint32_t value, size_t digits) {
  const std::string text = std::to_string(value);
  return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
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
  const auto parts = split_at_underscores(stem);
  if (!has_camera_position(parts)) return std::nullopt;
  const CameraPlace place{decimal_value(parts[3]), decimal_value(parts[4])};
  if (!std::isfinite(place.y) || !std::isfinite(place.x)) return std::nullopt;
  return place;
}

std::optional<uint32_t> parse_camera_name(std::string_view stem) {
  if (!stem.starts_with(kCameraPrefix)) return std::nullopt;
  return parse_digits(stem.substr(kCameraPrefix.size()), 8);
}

std::string view_stem(uint32_t row, uint32_t col, uint32_t rows, uint32_t cols) {
  const size_t digits = std::max<size_t>(2, std::to_string(std::max(rows, cols) - 1).size());
  return padded(row, digits) + "_" + padded(col, digits);
}

std::string view_file_name(uint32_t row, uint32_t col, uint32_t rows, uint32_t cols) {
  return view_stem(row, col, rows, cols) + ".png";
}

std::string camera_file_name(uint32_t index) {
  return std::string(kCameraPrefix) + padded(index, 3) + ".png";
}

std::string pleno_file_name(uint32_t row, uint32_t col) {
  return padded(col, 3) + "_" + padded(row, 3) + ".ppm";
}

}  // namespace hmlfc::io
