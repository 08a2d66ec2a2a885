#include "terminal/shown.hpp"

#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace hmlfc::terminal {
namespace {

// The code point at the front of `text` and its bytes; nothing where they are no UTF-8 (RFC 3629).
std::optional<std::pair<uint32_t, size_t>> front_of(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<uint32_t>(static_cast<uint8_t>(text[i])); };
  const uint32_t first = byte(0);
  if (first < 0x80) return std::pair(first, size_t{1});
  const size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (first < 0xC2 || first > 0xF4 || bytes > text.size()) return std::nullopt;
  uint32_t point = first & (0x7Fu >> bytes);
  for (size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return std::nullopt;
    point = point << 6 | (byte(i) & 0x3F);
  }
  const bool surrogate = point >= 0xD800 && point <= 0xDFFF;
  if (point < kLeast[bytes] || point > 0x10FFFF || surrogate) return std::nullopt;
  return std::pair(point, bytes);
}

bool is_control(uint32_t point) {
  const bool c0 = point < 0x20 && point != '\n' && point != '\t';
  const bool c1 = point >= 0x7F && point < 0xA0;
  const bool direction = point == 0x061C || point == 0x200E || point == 0x200F ||
                         (point >= 0x2028 && point <= 0x202E) ||
                         (point >= 0x2066 && point <= 0x2069);
  return c0 || c1 || direction;
}

}  // namespace

std::string shown(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const auto front = front_of(text);
    const size_t bytes = front ? front->second : 1;
    const bool line_end = text.substr(0, 2) == "\r\n";
    const uint32_t point = front ? front->first : static_cast<uint8_t>(text[0]);
    if (!front || (is_control(point) && !line_end)) {
      safe += fmt::format("\\u{:04x}", point);
    } else {
      safe += text.substr(0, bytes);
    }
    text.remove_prefix(bytes);
  }
  return safe;
}

}  // namespace hmlfc::terminal
