// Bounded integer sequences written a second time: digit codes as bit patterns, sequences as
// vectors of bools, level counts as a sorted list. Slow and plain; shares nothing with the model.
#pragma once

#include <cstdint>
#include <vector>

#include "bits/naive_bits.hpp"

namespace hmlfc::test {

/// What BISE-1 amounts to: all numbers of the form 2^n, 3 * 2^n or 5 * 2^n up to 16384, ascending.
/// The index is the level code.
std::vector<uint32_t> naive_level_counts();

/// t0 to t4 of code T in [0, 255] (BISE-8).
std::vector<uint32_t> naive_trits(unsigned T);

/// q0 to q2 of code Q in [0, 127] (BISE-9).
std::vector<uint32_t> naive_quints(unsigned Q);

/// The greatest code of `digits`, five trits or three quints (BISE-10).
unsigned naive_greatest_code(const std::vector<uint32_t>& digits);

/// Bits of `count` values of N levels (BISE-3).
uint64_t naive_bise_bits(uint32_t N, uint64_t count);

/// The `count` values of N levels that begin at bit `start`.
std::vector<uint32_t> naive_bise_decode(const NaiveBits& bits, size_t start, uint32_t N,
                                        size_t count);

/// Appends the canonical sequence of `values`; values that a cut group lacks count as 0.
void naive_bise_encode(NaiveBits& bits, uint32_t N, const std::vector<uint32_t>& values);

}  // namespace hmlfc::test
