// Records of tiles whose fields follow the rules of a recipe.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "arithmetic/bise.hpp"
#include "bits/bit_string.hpp"
#include "syntax/motion_tile.hpp"
#include "syntax/tile_record.hpp"
#include "vectors/field_rules.hpp"

namespace hmlfc::vectors {

/// With rule "group_code" sets the code of each group to the least that stands for the same digits
/// as the canonical one: another one where BISE-10 has several. None without digits.
void set_least_codes(const FieldRules& rules, SequenceFields& sequence);

/// By rule "tail_code" sets the code of the last group where it is cut; does nothing without the
/// rule, or a group.
void draw_tail_code(FieldRules& rules, SequenceFields& sequence, Random& random);

/// Throws TextError where a value is not below the number of levels.
void require_representable(const SequenceFields& sequence);

/// Groups of a sequence of `count` values; 0 without digits.
size_t code_count(const Levels& levels, size_t count);

/// Bits of the code of group `group` that a sequence of `count` values has (BISE-7); the bits of T
/// and Q are those of the first values.
unsigned code_bits(const Levels& levels, size_t count, size_t group);

/// The fields of a tile of `context`; none where it is empty. With rules that keep to intervals
/// (those without numbers do) the record is valid.
std::optional<TileFields> draw_tile(FieldRules& rules, const TileContext& context, Random& random);

/// The record of a motion tile of a predictive image; empty for an empty tile.
std::vector<uint8_t> draw_motion_record(FieldRules& rules, const MotionContext& context,
                                        Random& random);

/// The record of a motion tile of a reference image; empty for an empty tile.
std::vector<uint8_t> draw_disparity_record(FieldRules& rules, const DisparityContext& context,
                                           Random& random);

/// By rule "behind" appends [0, 3] bytes of ones to `record`; does nothing without the rule or a
/// record.
void append_trailing_ones(FieldRules& rules, std::vector<uint8_t>& record, Random& random);

/// The record of the fields written; with rule "behind", followed by ones to the end of its last
/// byte and as by append_trailing_ones. Empties the writer.
std::vector<uint8_t> with_trailing_ones(FieldRules& rules, BitWriter& writer, Random& random);

}  // namespace hmlfc::vectors
