#include "io/disparity_files.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <string>
#include <vector>

#include "io/files.hpp"

namespace hmlfc::io {
namespace {

constexpr size_t kMaxWord = 32;

// Takes the next word of the head, and the one space after it.
std::string take_word(std::span<const uint8_t>& bytes) {
  const auto is_space = [](uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  const auto begin = std::ranges::find_if_not(bytes, is_space);
  const auto limit = begin + std::min<ptrdiff_t>(kMaxWord, bytes.end() - begin);
  const auto end = std::find_if(begin, limit, is_space);
  std::string word(begin, end);
  bytes = bytes.subspan(static_cast<size_t>((end == bytes.end() ? end : end + 1) - bytes.begin()));
  return word;
}

// The whole of `word` as a number; 0 for other words.
template <class T>
T number(const std::string& word) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() ? value : T{};
}

}  // namespace

IoResult<void> write_pfm(const std::filesystem::path& path, uint32_t width, uint32_t height,
                         std::span<const float> pixels) {
  // The scale is negative for little-endian numbers.
  const std::string head =
      "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  std::vector<uint8_t> bytes(head.begin(), head.end());
  bytes.reserve(bytes.size() + pixels.size() * sizeof(float));
  // The format begins with the lowest row.
  for (uint32_t y = height; y-- > 0;) {
    for (const float pixel : pixels.subspan(size_t{y} * width, width)) {
      const auto word = std::bit_cast<uint32_t>(pixel);
      for (unsigned shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<uint8_t>(word >> shift));
      }
    }
  }
  return write_file(path, bytes);
}

IoResult<FloatMap> read_pfm(const std::filesystem::path& path) {
  const auto mapped = map_file(path);
  if (!mapped) return tl::unexpected(mapped.error());
  std::span<const uint8_t> bytes = mapped->bytes();
  const std::string kind = take_word(bytes);
  if (kind == "PF") return file_error(path, "a PFM of three channels; of a map, one is read");
  if (kind != "Pf") return file_error(path, "not a PFM file");
  FloatMap map{number<uint32_t>(take_word(bytes)), number<uint32_t>(take_word(bytes)), {}};
  const auto scale = number<double>(take_word(bytes));
  if (map.width < 1 || map.height < 1 || map.width > kMaxMapSide || map.height > kMaxMapSide ||
      !(scale < 0 || scale > 0)) {
    return file_error(path, "a damaged PFM: its head has no width, height and scale");
  }
  const uint64_t needed = uint64_t{4} * map.width * map.height;
  if (bytes.size() != needed) {
    return file_error(path, "a damaged PFM: " + std::to_string(bytes.size()) +
                                " bytes of pixels, not " + std::to_string(needed));
  }
  map.pixels.resize(size_t{map.width} * map.height);
  for (size_t i = 0; i < map.pixels.size(); ++i) {
    uint32_t word = 0;
    for (size_t k = 0; k < 4; ++k)
      word |= uint32_t{bytes[4 * i + k]} << (scale < 0 ? 8 * k : 24 - 8 * k);
    // The format begins with the lowest row.
    const size_t y = map.height - 1 - i / map.width;
    map.pixels[y * map.width + i % map.width] = std::bit_cast<float>(word);
  }
  return map;
}

}  // namespace hmlfc::io
