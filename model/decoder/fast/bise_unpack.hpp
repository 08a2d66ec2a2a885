// Fast reading of whole sequences, equal to bise_value for every input.
#pragma once

#include <cstddef>
#include <cstdint>

#include "arithmetic/levels.hpp"

namespace hmlfc {

/// Bytes past the end of a sequence that bise_unpack may read; their content does not matter.
inline constexpr size_t kBiseUnpackSlack = 8;

/// Writes the `count` values of the sequence at bit `start` of `bytes` to `out`. The bytes up to
/// the sequence's end and kBiseUnpackSlack bytes more must be readable.
void bise_unpack(const uint8_t* bytes, uint64_t start, const Levels& levels, size_t count,
                 uint16_t* out);

}  // namespace hmlfc
