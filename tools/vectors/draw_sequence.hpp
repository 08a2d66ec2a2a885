// Codes of groups that an encoder would not write (BISE-7, BISE-10).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "arithmetic/bise.hpp"
#include "syntax/tile_record.hpp"
#include "vectors/field_rules.hpp"

namespace hmlfc::vectors {

/// The least code of each group that stands for the same digits as the canonical one: another one
/// where BISE-10 has several. None without digits.
std::vector<uint32_t> least_codes(const Levels& levels, std::span<const uint32_t> values);

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

}  // namespace hmlfc::vectors
