#include "io/y4m_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace hmlfc::io {
namespace {

constexpr std::string_view kMagic = "YUV4MPEG2";
constexpr std::string_view kNote = "XHMLFC=";
constexpr std::string_view kRange = "XCOLORRANGE=";
constexpr uint32_t kMaxSide = 65536;

struct ColourSpace {
  std::string_view name;
  int bits;
};
constexpr std::array<ColourSpace, 4> kColourSpaces{
    {{"444", 8}, {"444p10", 10}, {"444p12", 12}, {"444p14", 14}}};

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t end = text.find(separator); end != text.npos; end = text.find(separator)) {
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

// A number in [1, most] and nothing else.
std::optional<uint32_t> number(std::string_view text, uint32_t most) {
  uint32_t value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = failure == std::errc() && end == text.data() + text.size();
  if (!is_whole || value < 1 || value > most) return std::nullopt;
  return value;
}

std::optional<Y4mNote> parse_note(std::string_view text) {
  const auto parts = split(text, ',');
  if (parts.size() != 3) return std::nullopt;
  const auto sides = split(parts[0], 'x');
  const auto depth = number(parts[2], 12);
  if (sides.size() != 2 || !depth || *depth < 8) return std::nullopt;
  const auto rows = number(sides[0], kMaxGridSide);
  const auto cols = number(sides[1], kMaxGridSide);
  const auto* const order =
      std::ranges::find(kFrameOrders, parts[1], &decltype(kFrameOrders)::value_type::first);
  if (!rows || !cols || order == kFrameOrders.end()) return std::nullopt;
  return Y4mNote{{*rows, *cols}, order->second, static_cast<int>(*depth)};
}

tl::unexpected<std::string> wrong(std::string_view word, std::string_view what) {
  return tl::unexpected(fmt::format("\"{}\" {}", word, what));
}

// Takes one word of the header after the first.
tl::expected<void, std::string> take(std::string_view word, Y4mHeader& header) {
  const std::string_view value = word.substr(1);
  if (word[0] == 'W' || word[0] == 'H') {
    const auto side = number(value, kMaxSide);
    if (!side) return wrong(word, "is no width or height in [1, 65536]");
    (word[0] == 'W' ? header.width : header.height) = *side;
  } else if (word[0] == 'C') {
    const auto* const space = std::ranges::find(kColourSpaces, value, &ColourSpace::name);
    if (space == kColourSpaces.end()) {
      return wrong(word,
                   "is not 4:4:4 of 8, 10, 12 or 14 bits; ffmpeg -i IN -pix_fmt yuv444p10 "
                   "-strict -1 OUT.y4m converts it");
    }
    header.levels.bits = space->bits;
  } else if (word[0] == 'I' && value != "p" && value != "?") {
    return wrong(word, "means interlaced frames, which views are not");
  } else if (word.starts_with(kRange)) {
    header.levels.full_range = word.substr(kRange.size()) == "FULL";
  } else if (word.starts_with(kNote)) {
    header.note = parse_note(word.substr(kNote.size()));
    if (!header.note) return wrong(word, "is not ROWSxCOLS,ORDER,DEPTH");
  }
  return {};
}

}  // namespace

std::string write_y4m_header(const Y4mHeader& header) {
  const auto* const space =
      std::ranges::find(kColourSpaces, header.levels.bits, &ColourSpace::bits);
  std::string line =
      fmt::format("{} W{} H{} F30:1 Ip A1:1 C{} {}{}", kMagic, header.width, header.height,
                  space->name, kRange, header.levels.full_range ? "FULL" : "LIMITED");
  if (header.note) {
    const auto& [grid, order, depth] = *header.note;
    line += fmt::format(" {}{},{},{}", kNote, describe(grid),
                        kFrameOrders[static_cast<size_t>(order)].first, depth);
  }
  return line;
}

tl::expected<Y4mHeader, std::string> parse_y4m_header(std::string_view line) {
  const auto words = split(line, ' ');
  if (words.front() != kMagic) return tl::unexpected(std::string("not a Y4M video"));
  Y4mHeader header;
  bool has_colour_space = false;
  for (const std::string_view word : std::span(words).subspan(1)) {
    if (word.empty()) continue;
    has_colour_space = has_colour_space || word[0] == 'C';
    if (auto ok = take(word, header); !ok) return tl::unexpected(ok.error());
  }
  if (header.width == 0 || header.height == 0) {
    return tl::unexpected(std::string("the header lacks W or H, the size of a frame"));
  }
  if (!has_colour_space) return take("C420", header).map([&] { return header; });
  return header;
}

}  // namespace hmlfc::io
