#include "vectors/draw.hpp"

#include <algorithm>
#include <bit>
#include <string>

#include "arithmetic/bise.hpp"
#include "arithmetic/motion.hpp"
#include "arithmetic/rounding.hpp"
#include "syntax/motion_tile.hpp"

namespace hmlfc::vectors {
namespace {

constexpr int64_t kMaxMotionBlock = 3;
constexpr int64_t kReservedChoices = 15;

PaletteEntry draw_symbol(FieldRules& rules, const MotionContext& context, unsigned explicit_bits,
                         Random& random) {
  PaletteEntry symbol;
  if (context.two_references) {
    symbol.reference_set = static_cast<uint8_t>(rules.pick("reference_set", 0, 7, random));
  }
  symbol.choice = static_cast<uint8_t>(rules.pick("choice", 0, kReservedChoices, random));
  symbol.negative = !context.keyed && rules.pick("sign", 0, 1, random) != 0;
  const int64_t half = explicit_bits == 0 ? 0 : int64_t{1} << (explicit_bits - 1);
  const int64_t most = std::max<int64_t>(half - 1, 0);
  const auto component = [&](const char* field) {
    const int64_t value = rules.pick(field, -half, most, random);
    if (value < -half || value > most) {
      throw TextError(std::string("a rule gives ") + field + " more bits than explicit_bits");
    }
    return static_cast<int16_t>(value);
  };
  symbol.explicit_x = component("explicit_x");
  symbol.explicit_y = component("explicit_y");
  return symbol;
}

// The palette's entries that blocks may use (MOT-3).
std::vector<uint32_t> usable_entries(const std::vector<PaletteEntry>& palette,
                                     const MotionContext& context) {
  std::vector<uint32_t> usable;
  for (size_t i = 0; i < palette.size(); ++i) {
    PaletteEntry entry;
    entry.choice = palette[i].choice;
    if (is_usable(entry, context)) usable.push_back(static_cast<uint32_t>(i));
  }
  return usable;
}

}  // namespace

std::vector<uint8_t> draw_motion_record(FieldRules& rules, const MotionContext& context,
                                        Random& random) {
  if (!rules.present("motion_density", random)) return {};
  MotionTileFields tile;
  const auto least =
      std::max(0, static_cast<int>(std::bit_width(context.block_size)) - 3);  // m >= B
  tile.block_log2 = 2 + rules.pick_unsigned("motion_block", static_cast<uint64_t>(least),
                                            kMaxMotionBlock, random);
  const auto entries = rules.pick_unsigned("palette_size", 0, kMaxPaletteEntries - 1, random) + 1;
  tile.explicit_bits = rules.pick_unsigned("explicit_bits", 0, kMaxExplicitBits, random);
  for (uint32_t i = 0; i < entries; ++i) {
    tile.palette.push_back(draw_symbol(rules, context, tile.explicit_bits, random));
  }
  if (usable_entries(tile.palette, context).empty()) tile.palette.back().choice = kChoiceVector;
  const std::vector<uint32_t> usable = usable_entries(tile.palette, context);
  const uint32_t blocks = ceil_div(context.width, 1u << tile.block_log2) *
                          ceil_div(context.height, 1u << tile.block_log2);
  tile.indices.level_code = level_code_for(entries);
  for (uint32_t i = 0; i < blocks; ++i) {
    const auto at = rules.pick_unsigned("index", 0, usable.size() - 1, random);
    if (at >= usable.size()) throw TextError("a rule gives an index beyond the usable entries");
    tile.indices.values.push_back(usable[at]);
  }
  set_least_codes(rules, tile.indices);
  draw_tail_code(rules, tile.indices, random);
  BitWriter writer;
  put_motion_fields(writer, tile, {context.two_references, !context.keyed});
  return with_trailing_ones(rules, writer, random);
}

std::vector<uint8_t> draw_disparity_record(FieldRules& rules, const DisparityContext& context,
                                           Random& random) {
  if (!rules.present("disparity_density", random)) return {};
  SequenceFields values;
  values.level_code = rules.pick_unsigned("disparity_code", 0, kMaxDisparityCode, random);
  // Half of them near 0, since most others are clamped to the window.
  const bool near = !rules.has("min_disparity") && random.below(2) == 0;
  const int64_t least =
      near ? static_cast<int64_t>(random.below(80)) - 60
           : rules.pick("min_disparity", -kMaxDisparity - 1, kMaxDisparity, random);
  const int64_t levels = levels_of_code(values.level_code).count;
  const int64_t most = std::clamp<int64_t>(kMaxDisparity - least, 0, levels - 1);
  for (uint64_t i = 0; i < context.blocks(); ++i) {
    values.values.push_back(
        rules.pick_unsigned("disparity", 0, static_cast<uint64_t>(most), random));
  }
  require_representable(values);
  set_least_codes(rules, values);
  draw_tail_code(rules, values, random);
  BitWriter writer;
  put_disparity_fields(writer, static_cast<int32_t>(least), values);
  return with_trailing_ones(rules, writer, random);
}

}  // namespace hmlfc::vectors
