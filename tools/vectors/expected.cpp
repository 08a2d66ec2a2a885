#include "vectors/expected.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "bits/crc32c.hpp"
#include "vectors/picture_bytes.hpp"

namespace hmlfc::vectors {
namespace {

// The checksums of a view's blocks, separated by spaces; "--------" for one that does not decode.
std::string block_sums(const Decoder& decoder, ViewPos view) {
  const StreamHeader& header = decoder.header();
  const uint32_t side = header.block_size();
  std::string sums;
  for (uint32_t y = 0; y < header.height; y += side) {
    for (uint32_t x = 0; x < header.width; x += side) {
      const Rect rect{x, y, std::min(side, header.width - x), std::min(side, header.height - y)};
      const auto image = decoder.decode_rgb(view, rect);
      if (!sums.empty()) sums += ' ';
      sums += image ? fmt::format("{:08x}", crc32c(picture_bytes(*image))) : "--------";
    }
  }
  return sums;
}

}  // namespace

ExpectedViews expected_views(const Decoder& decoder) {
  const StreamHeader& header = decoder.header();
  ExpectedViews expected;
  expected.raw.emplace();
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      expected.blocks += fmt::format("{} {}\n{}\n", row, col, block_sums(decoder, {row, col}));
      if (!expected.raw) continue;
      const auto image = decoder.decode_view({row, col});
      if (!image) {
        expected.raw.reset();
        continue;
      }
      const std::vector<uint8_t> bytes = picture_bytes(*image);
      expected.raw->insert(expected.raw->end(), bytes.begin(), bytes.end());
    }
  }
  return expected;
}

}  // namespace hmlfc::vectors
