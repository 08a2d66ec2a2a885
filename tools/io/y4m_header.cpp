#include "io/y4m_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "io/files.hpp"

namespace hmlfc::io {
namespace {

constexpr std::string_view kMagic = "YUV4MPEG2";
constexpr std::string_view kNote = "XHMLFC=";
constexpr std::string_view kRange = "XCOLORRANGE=";
constexpr uint32_t kMaxSide = 65536;

constexpr std::string_view kNotRead =
    "is not 4:4:4, 4:2:2, 4:2:0 or mono of 8 to 16 bits; ffmpeg -i IN -pix_fmt yuv444p10 -strict "
    "-1 "
    "OUT.y4m converts it";
constexpr std::string_view kSubsampling = "XYSCSS=";

struct ColourSpace {
  std::string_view name;  // p and bits may follow
  ChromaPlanes chroma;
};
using enum ChromaSide;
constexpr auto kColourSpaces = std::to_array<ColourSpace>({
    {"444", {}},
    {"422", {true, kCosited, kEach}},
    {"420jpeg", {true, kCentred, kCentred}},
    {"420mpeg2", {true, kCosited, kCentred}},
    {"420paldv", {true, kCosited, kCosited}},
    {"420p", {true, kCosited, kCentred}},  // the rule of H.264 and later
    {"420", {true, kCentred, kCentred}},
    {"mono", {false}},
});

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

// Reads the value of a word C or XYSCSS, which names planes and bits.
bool take_colour_space(std::string_view value, Y4mHeader& header) {
  const std::string name = lower_case(std::string(value));
  const auto* const space = std::ranges::find_if(
      kColourSpaces, [&](const ColourSpace& each) { return name.starts_with(each.name); });
  if (space == kColourSpaces.end()) return false;
  std::string_view rest = std::string_view(name).substr(space->name.size());
  const bool has_bits = !rest.empty();
  if (rest.starts_with('p')) rest.remove_prefix(1);
  const auto bits = has_bits ? number(rest, 16) : 8;
  if (!bits || *bits < 8) return false;
  header.chroma = space->chroma;
  header.levels.bits = static_cast<int>(*bits);
  return true;
}

// Takes one word of the header after the first.
tl::expected<void, std::string> take(std::string_view word, Y4mHeader& header) {
  const std::string_view value = word.substr(1);
  if (word[0] == 'W' || word[0] == 'H') {
    const auto side = number(value, kMaxSide);
    if (!side) return wrong(word, "is no width or height in [1, 65536]");
    (word[0] == 'W' ? header.width : header.height) = *side;
  } else if (word[0] == 'C') {
    if (!take_colour_space(value, header)) {
      return wrong(word, kNotRead);
    }
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
  const int bits = header.levels.bits;
  std::string line = fmt::format("{} W{} H{} F30:1 Ip A1:1 C444{} {}{}", kMagic, header.width,
                                 header.height, bits == 8 ? "" : fmt::format("p{}", bits), kRange,
                                 header.levels.full_range ? "FULL" : "LIMITED");
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
  const auto find = [&](std::string_view start) {
    const auto found =
        std::ranges::find_if(words.begin() + 1, words.end(),
                             [&](std::string_view word) { return word.starts_with(start); });
    return found == words.end() ? std::string_view() : *found;
  };
  for (const std::string_view word : std::span(words).subspan(1)) {
    if (word.empty()) continue;
    if (auto ok = take(word, header); !ok) return tl::unexpected(ok.error());
  }
  if (header.width == 0 || header.height == 0) {
    return tl::unexpected(std::string("the header lacks W or H, the size of a frame"));
  }
  if (find("C").empty()) {
    const std::string_view older = find(kSubsampling);
    const auto value = older.empty() ? "420" : older.substr(kSubsampling.size());
    if (!take_colour_space(value, header)) return wrong(older, kNotRead);
    if (older.empty()) header.guessed = "no C word: 4:2:0";
  }
  const auto guess = [&header](std::string_view what) {
    header.guessed += (header.guessed.empty() ? "" : "; ") + std::string(what);
  };
  if (find(kRange).empty()) guess("no XCOLORRANGE word: black is 16, white 235");
  if (header.chroma.there && !header.note) {
    guess(
        "colours are those of BT.709 (ffmpeg makes BT.601 of RGB without -vf "
        "scale=out_color_matrix=bt709)");
  }
  return header;
}

}  // namespace hmlfc::io
