// Bounded integer sequences by the codes of their groups (BISE-5 to BISE-7, BISE-10).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "arithmetic/levels.hpp"
#include "bits/bit_writer.hpp"

namespace hmlfc {

/// Values of a group: 5 with trits, 3 with quints, 1 without digits.
size_t group_size(const Levels& levels);

/// The canonical T or Q of each group of `values`, each in [0, levels.count - 1]; none without
/// digits.
std::vector<uint32_t> canonical_codes(const Levels& levels, std::span<const uint32_t> values);

/// Appends a sequence of values.size() values: of each value its plain bits alone, and of each
/// group the code T or Q in `codes`, of which the last group has the bits that BISE-7 leaves.
/// `codes` has one entry for each group, or none without digits.
void bise_put_codes(BitWriter& writer, const Levels& levels, std::span<const uint32_t> values,
                    std::span<const uint32_t> codes);

}  // namespace hmlfc
