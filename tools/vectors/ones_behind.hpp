// What stands behind the last field of a record (TIL-1).
#pragma once

#include <cstdint>
#include <vector>

#include "bits/bit_string.hpp"
#include "vectors/field_rules.hpp"

namespace hmlfc::vectors {

/// By rule "behind" appends that many bytes of ones, [0, 3], to `record`; without the rule, or a
/// record, does nothing.
void append_ones(FieldRules& rules, std::vector<uint8_t>& record, Random& random);

/// The record of the fields written, and, with rule "behind", ones in the rest of its last byte and
/// as append_ones. The writer is empty afterwards.
std::vector<uint8_t> with_ones_behind(FieldRules& rules, BitWriter& writer, Random& random);

}  // namespace hmlfc::vectors
