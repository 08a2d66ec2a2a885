// Pseudo-random numbers, the same on every machine.
#pragma once

#include <cstdint>
#include <utility>

#include "scenes/hash_noise.hpp"

namespace hmlfc::vectors {

/// A generator of 64-bit numbers (SplitMix64).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint64_t next() { return scenes::mix_bits(std::exchange(state_, state_ + 0x9e3779b97f4a7c15u)); }

  /// A number in [0, count - 1]; count in [1, 2^32].
  uint32_t below(uint64_t count) { return static_cast<uint32_t>((next() >> 32) * count >> 32); }

  /// A number in [lo, hi].
  uint32_t within(uint32_t lo, uint32_t hi) { return lo + below(uint64_t{hi} - lo + 1); }

  /// True with a probability of `permille` / 1000.
  bool chance(unsigned permille) { return permille != 0 && below(1000) < permille; }

 private:
  uint64_t state_;
};

}  // namespace hmlfc::vectors
