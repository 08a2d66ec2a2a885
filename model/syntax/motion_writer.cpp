#include "syntax/motion_writer.hpp"

#include <algorithm>
#include <bit>

#include "arithmetic/levels.hpp"

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
  const bool vector = symbol.choice == kChoiceVector;
  if (vector || symbol.choice == kChoiceDisparity) writer.put_signed(symbol.explicit_x, bits);
  if (vector) writer.put_signed(symbol.explicit_y, bits);
}

}  // namespace

void put_motion_fields(BitWriter& writer, const MotionTileFields& tile,
                       const PaletteFields& fields) {
  writer.put(tile.block_log2 - 2, 2);
  writer.put(static_cast<uint32_t>(tile.palette.size() - 1), 3);
  writer.put(tile.explicit_bits, 4);
  for (const MotionSymbol& symbol : tile.palette) {
    put_symbol(writer, symbol, fields, tile.explicit_bits);
  }
  put_sequence(writer, tile.indices);
}

std::vector<uint8_t> write_motion_tile(const MotionTileCode& tile, const PaletteFields& fields) {
  if (tile.empty) return {};
  MotionTileFields record{tile.block_log2, explicit_bits(tile.palette), tile.palette, {}};
  record.indices.level_code = level_code_for(static_cast<uint32_t>(tile.palette.size()));
  record.indices.values.assign(tile.indices.begin(), tile.indices.end());
  BitWriter writer;
  put_motion_fields(writer, record, fields);
  return writer.take();
}

void put_disparity_fields(BitWriter& writer, int32_t min_disparity, const SequenceFields& values) {
  writer.put_signed(min_disparity, 13);
  writer.put(values.level_code, 5);
  put_sequence(writer, values);
}

std::vector<uint8_t> write_disparity_tile(std::span<const int16_t> values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*least == 0 && *most == 0) return {};
  SequenceFields above;
  above.level_code = level_code_for(static_cast<uint32_t>(*most - *least) + 1);
  for (const int16_t value : values) above.values.push_back(static_cast<uint32_t>(value - *least));
  BitWriter writer;
  put_disparity_fields(writer, *least, above);
  return writer.take();
}

}  // namespace hmlfc
