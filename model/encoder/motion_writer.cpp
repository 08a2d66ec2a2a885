#include "encoder/motion_writer.hpp"

#include <algorithm>
#include <bit>

#include "bits/bit_writer.hpp"
#include "values/bise.hpp"

namespace hmlfc {
namespace {

unsigned signed_bits(int32_t value) {
  if (value == 0) return 0;
  const auto magnitude = static_cast<uint32_t>(value < 0 ? -value - 1 : value);
  return static_cast<unsigned>(std::bit_width(magnitude)) + 1;
}

unsigned explicit_bits(std::span<const MotionSymbol> palette) {
  unsigned bits = 0;
  for (const MotionSymbol& symbol : palette) {
    bits = std::max({bits, signed_bits(symbol.explicit_x), signed_bits(symbol.explicit_y)});
  }
  return bits;
}

void put_symbol(BitWriter& writer, const MotionSymbol& symbol, const PaletteFields& fields,
                unsigned bits) {
  if (fields.reference_set) writer.put(symbol.reference_set, 3);
  writer.put(symbol.choice, 4);
  if (fields.sign) writer.put(symbol.negative ? 1 : 0, 1);
  if (symbol.choice >= kChoiceDisparity) writer.put_signed(symbol.explicit_x, bits);
  if (symbol.choice > kChoiceDisparity) writer.put_signed(symbol.explicit_y, bits);
}

}  // namespace

std::vector<uint8_t> write_motion_tile(const MotionTileCode& tile, const PaletteFields& fields) {
  if (tile.empty) return {};
  BitWriter writer;
  const auto size = static_cast<uint32_t>(tile.palette.size());
  const unsigned bits = explicit_bits(tile.palette);
  writer.put(tile.block_log2 - 2, 2);
  writer.put(size - 1, 3);
  writer.put(bits, 4);
  for (const MotionSymbol& symbol : tile.palette) put_symbol(writer, symbol, fields, bits);
  const std::vector<uint32_t> indices(tile.indices.begin(), tile.indices.end());
  bise_put(writer, levels_of_code(level_code_for(size)), indices);
  return writer.take();
}

std::vector<uint8_t> write_disparity_tile(std::span<const int16_t> values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*least == 0 && *most == 0) return {};
  BitWriter writer;
  const unsigned code = level_code_for(static_cast<uint32_t>(*most - *least) + 1);
  writer.put_signed(*least, 13);
  writer.put(code, 5);
  std::vector<uint32_t> above;
  for (const int16_t value : values) above.push_back(static_cast<uint32_t>(value - *least));
  bise_put(writer, levels_of_code(code), above);
  return writer.take();
}

}  // namespace hmlfc
