#include "vectors/draw.hpp"

#include <algorithm>
#include <bit>
#include <string>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "syntax/tile_masks.hpp"
#include "vectors/json.hpp"

namespace hmlfc::vectors {

namespace {

constexpr uint64_t kMaxTrailingBytes = 3;

constexpr int64_t kMaxLevelBits = 6;
constexpr int64_t kMaxStepBits = 3;

// A mode of TIL-3 that can express `mask`: the one that the rule picks, otherwise the shortest.
uint32_t draw_mode(FieldRules& rules, const std::string& field, uint64_t mask, uint64_t inside,
                   Random& random) {
  const auto picked = rules.pick_unsigned(field, kMaskNone, kMaskQuads, random);
  const bool fits =
      picked == kMaskRaw || picked == kMaskQuads || mask == (picked == kMaskNone ? 0 : inside);
  return fits ? picked : mask_mode(mask, inside);
}

// The names of the fields of one vector component.
struct ComponentNames {
  const char* least;
  const char* code;
  const char* component;
};

SequenceFields draw_component(FieldRules& rules, const ComponentNames& names, int window,
                              size_t count, int32_t& least, Random& random) {
  SequenceFields sequence;
  sequence.level_code = rules.pick_unsigned(names.code, 0, vector_widths(window).max_code, random);
  least = static_cast<int32_t>(rules.pick(names.least, -window, window, random));
  const auto levels = static_cast<int32_t>(levels_of_code(sequence.level_code).count);
  const int32_t most = std::max(least, std::min(window, least + levels - 1));
  for (size_t i = 0; i < count; ++i) {
    const int64_t component = rules.pick(names.component, least, most, random);
    sequence.values.push_back(static_cast<uint32_t>(component - least));
  }
  require_representable(sequence);
  set_least_codes(rules, sequence);
  return sequence;
}

VectorFields draw_vectors(FieldRules& rules, const TileContext& context, size_t count,
                          Random& random) {
  VectorFields vectors;
  vectors.sign_mode = rules.pick_unsigned("sign_mode", 0, 2, random);
  for (size_t i = 0; i < count; ++i) {
    vectors.negative.push_back(rules.pick("sign", 0, 1, random) != 0);
  }
  vectors.x = draw_component(rules, {"min_x", "codes_x", "dx"}, context.window, count,
                             vectors.min_x, random);
  vectors.y = draw_component(rules, {"min_y", "codes_y", "dy"}, context.window, count,
                             vectors.min_y, random);
  return vectors;
}

SequenceFields draw_values(FieldRules& rules, unsigned level_code, uint64_t count, Random& random) {
  SequenceFields sequence;
  sequence.level_code = level_code;
  const Levels levels = levels_of_code(level_code);
  for (uint64_t i = 0; i < count; ++i) {
    sequence.values.push_back(rules.pick_unsigned("value", 0, levels.count - 1, random));
  }
  require_representable(sequence);
  if (!rules.has("group_code")) return sequence;
  for (size_t g = 0; g < code_count(levels, count); ++g) {
    const unsigned bits = code_bits(levels, count, g);
    const bool cut = bits < code_bits(levels, digit_group_size(levels), 0);
    const char* field = cut && rules.has("tail_code") ? "tail_code" : "group_code";
    sequence.codes.push_back(rules.pick_unsigned(field, 0, (1u << bits) - 1, random));
  }
  return sequence;
}

// Throws TextError unless the block's header fits in the bits that the tile gives it.
void require_representable(const ResidualFields& fields, const ResidualBlockFields& block) {
  const unsigned level_delta = block.values.level_code - fields.level_base;
  const unsigned step_delta = block.step_code - fields.step_base;
  const int32_t half = fields.bias_bits == 0 ? 0 : 1 << (fields.bias_bits - 1);
  const bool bias_fits = block.bias >= -half && block.bias <= std::max(half - 1, 0);
  if ((level_delta >> fields.level_bits) == 0 && (step_delta >> fields.step_bits) == 0 &&
      bias_fits) {
    return;
  }
  throw TextError(
      "rules give a block a level_code, step_code or bias that its tile has no bits for");
}

ResidualFields draw_residuals(FieldRules& rules, const TileContext& context, size_t count,
                              Random& random) {
  ResidualFields fields;
  const unsigned most_code = max_residual_level_code(context.depth);
  fields.level_base = rules.pick_unsigned("level_base", 0, most_code, random);
  fields.level_bits = rules.pick_unsigned("level_bits", 0, kMaxLevelBits, random);
  fields.bias_bits =
      rules.pick_unsigned("bias_bits", 0, static_cast<uint64_t>(context.depth) + 2, random);
  if (context.steps) {
    fields.step_base = rules.pick_unsigned("step_base", 0, kMaxStepCode, random);
    fields.step_bits = rules.pick_unsigned("step_bits", 0, kMaxStepBits, random);
  }
  const unsigned top_code = std::max(
      fields.level_base, std::min(most_code, fields.level_base + (1u << fields.level_bits) - 1));
  const unsigned top_step = std::max(
      fields.step_base, std::min(kMaxStepCode, fields.step_base + (1u << fields.step_bits) - 1));
  const int64_t half = fields.bias_bits == 0 ? 0 : int64_t{1} << (fields.bias_bits - 1);
  for (size_t i = 0; i < count; ++i) {
    ResidualBlockFields block;
    const unsigned code = rules.pick_unsigned("level_code", fields.level_base, top_code, random);
    if (context.steps) {
      block.step_code = rules.pick_unsigned("step_code", fields.step_base, top_step, random);
    }
    block.bias =
        static_cast<int32_t>(rules.pick("bias", -half, std::max<int64_t>(half - 1, 0), random));
    block.values = draw_values(rules, code, context.block_samples, random);
    require_representable(fields, block);
    fields.blocks.push_back(std::move(block));
  }
  return fields;
}

}  // namespace

void set_least_codes(const FieldRules& rules, SequenceFields& sequence) {
  if (!rules.has("group_code")) return;
  const Levels levels = levels_of_code(sequence.level_code);
  sequence.codes = canonical_codes(levels, sequence.values);
  for (uint32_t& code : sequence.codes) {
    uint32_t least = 0;
    if (levels.digit == Digit::kTrit) {
      while (trits_of_code(least) != trits_of_code(code)) ++least;
    } else {
      while (quints_of_code(least) != quints_of_code(code)) ++least;
    }
    code = least;
  }
}

void draw_tail_code(FieldRules& rules, SequenceFields& sequence, Random& random) {
  const Levels levels = levels_of_code(sequence.level_code);
  const size_t groups = code_count(levels, sequence.values.size());
  if (!rules.has("tail_code") || sequence.values.size() % digit_group_size(levels) == 0) return;
  if (sequence.codes.empty()) sequence.codes = canonical_codes(levels, sequence.values);
  const unsigned bits = code_bits(levels, sequence.values.size(), groups - 1);
  sequence.codes.back() = rules.pick_unsigned("tail_code", 0, (1u << bits) - 1, random);
}

void require_representable(const SequenceFields& sequence) {
  const uint32_t levels = levels_of_code(sequence.level_code).count;
  for (const uint32_t value : sequence.values) {
    if (value < levels) continue;
    throw TextError("a rule gives value " + std::to_string(static_cast<int32_t>(value)) +
                    " of a sequence of " + std::to_string(levels) + " levels");
  }
}

size_t code_count(const Levels& levels, size_t count) {
  if (levels.digit == Digit::kNone) return 0;
  const size_t members = digit_group_size(levels);
  return (count + members - 1) / members;
}

unsigned code_bits(const Levels& levels, size_t count, size_t group) {
  const size_t members =
      std::min(digit_group_size(levels), count - group * digit_group_size(levels));
  return static_cast<unsigned>(bise_bits(levels, members) - levels.plain_bits * members);
}

void append_trailing_ones(FieldRules& rules, std::vector<uint8_t>& record, Random& random) {
  if (record.empty() || !rules.has("behind")) return;
  record.resize(record.size() + rules.pick_unsigned("behind", 0, kMaxTrailingBytes, random), 0xFF);
}

std::vector<uint8_t> with_trailing_ones(FieldRules& rules, BitWriter& writer, Random& random) {
  const auto rest = static_cast<unsigned>((8 - writer.size() % 8) % 8);
  if (rules.has("behind")) writer.put((1u << rest) - 1, rest);
  std::vector<uint8_t> record = writer.take();
  append_trailing_ones(rules, record, random);
  return record;
}

std::optional<TileFields> draw_tile(FieldRules& rules, const TileContext& context, Random& random) {
  if (!rules.present("density", random)) return std::nullopt;
  TileFields tile;
  if (context.predictive) {
    tile.motion_mask = rules.pick_mask("motion_mask", context.blocks_inside, random);
    tile.motion_mode =
        draw_mode(rules, "motion_mode", tile.motion_mask, context.blocks_inside, random);
  }
  tile.residual_mask = rules.pick_mask("residual_mask", context.blocks_inside, random);
  tile.residual_mode =
      draw_mode(rules, "residual_mode", tile.residual_mask, context.blocks_inside, random);
  if (tile.motion_mask != 0) {
    const auto count = static_cast<size_t>(std::popcount(tile.motion_mask));
    tile.vectors = draw_vectors(rules, context, count, random);
  }
  if (tile.residual_mask != 0) {
    const auto count = static_cast<size_t>(std::popcount(tile.residual_mask));
    tile.residuals = draw_residuals(rules, context, count, random);
  }
  return tile;
}

}  // namespace hmlfc::vectors
