// Draws tile records whose fields follow the rules of a recipe.
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

/// By rule "group_code", gives each digit group the least code that stands for its digits, which
/// is not the canonical one where BISE-10 has several.
void set_least_codes(const FieldRules& rules, SequenceFields& sequence);

/// By rule "tail_code", sets the code of the last digit group if it is cut; does nothing without
/// the rule or a digit group.
void draw_tail_code(FieldRules& rules, SequenceFields& sequence, Random& random);

/// Throws TextError if a value is not below the level count.
void require_representable(const SequenceFields& sequence);

/// Digit groups of a sequence of `count` values; 0 without digits.
size_t code_count(const Levels& levels, size_t count);

/// Bits that a sequence of `count` values has of the code of digit group `group` (BISE-7): the
/// lower bits of T or Q, which belong to the first values.
unsigned code_bits(const Levels& levels, size_t count, size_t group);

/// The fields of a tile of `context`; none if it is empty. The record is valid if the rules keep to
/// the fields' intervals, as those without numbers do.
std::optional<TileFields> draw_tile(FieldRules& rules, const TileContext& context, Random& random);

/// The record of a motion tile of a predictive image; empty for an empty tile.
std::vector<uint8_t> draw_motion_record(FieldRules& rules, const MotionContext& context,
                                        Random& random);

/// The record of a motion tile of a reference image; empty for an empty tile.
std::vector<uint8_t> draw_disparity_record(FieldRules& rules, const DisparityContext& context,
                                           Random& random);

/// By rule "behind", appends [0, 3] bytes of ones to `record`; does nothing without the rule or if
/// the record is empty.
void append_trailing_ones(FieldRules& rules, std::vector<uint8_t>& record, Random& random);

/// The record of the fields written. With rule "behind", ones fill its last byte and follow as in
/// append_trailing_ones. Empties the writer.
std::vector<uint8_t> with_trailing_ones(FieldRules& rules, BitWriter& writer, Random& random);

}  // namespace hmlfc::vectors
