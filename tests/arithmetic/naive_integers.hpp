// Integers by their definitions, in 64 bits.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hmlfc::test {

inline int64_t between(int64_t lo, int64_t x, int64_t hi) { return std::max(lo, std::min(x, hi)); }

/// The greatest integer not above x / y, y > 0.
inline int64_t floor_of(int64_t x, int64_t y) {
  int64_t quotient = x / y;
  while (quotient * y > x) --quotient;
  return quotient;
}

inline int64_t power_of_two(unsigned exponent) {
  int64_t power = 1;
  for (unsigned i = 0; i < exponent; ++i) power *= 2;
  return power;
}

/// rshift of MOT-8: the nearest integer to x / 2^k, the greater of two.
inline int64_t rounded(int64_t x, unsigned k) {
  return floor_of(2 * x + power_of_two(k), 2 * power_of_two(k));
}

}  // namespace hmlfc::test
