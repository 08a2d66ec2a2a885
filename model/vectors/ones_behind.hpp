// What stands behind the last field of a record (TIL-1).
#pragma once

#include <cstdint>
#include <vector>

#include "vectors/field_rules.hpp"

namespace hmlfc::vectors {

/// By rule "behind" sets the bits behind the first `bits` of `record` to 1 and appends that many
/// bytes of ones, [0, 3]; without the rule, or a record, does nothing.
/// bits  [8 * record.size() - 7, 8 * record.size()]; 0 for no record
void put_ones_behind(FieldRules& rules, uint64_t bits, std::vector<uint8_t>& record,
                     Random& random);

}  // namespace hmlfc::vectors
