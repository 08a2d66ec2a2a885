// Every rounding, shift and clamp of the decoder, by name (CNV-1, CNV-2, MOT-8).
#pragma once

#include <concepts>
#include <cstdint>

namespace hmlfc {

/// Floor of x / 2^k, for negative x too (CNV-1); k in [0, 30].
///
/// Example: floor_shift(-3, 1) = -2.
constexpr int32_t floor_shift(int32_t x, int k) { return x >> k; }

/// rshift of MOT-8: x / 2^k rounded to the nearest integer, halves up; k in [0, 9], |x| < 2^30.
///
/// Example: round_shift(3, 1) = 2, round_shift(-3, 1) = -1.
constexpr int32_t round_shift(int32_t x, unsigned k) {
  return k == 0 ? x : (x + (int32_t{1} << (k - 1))) >> k;
}

/// The smallest integer not below x / y; y >= 1.
///
/// Example: ceil_div(9u, 4u) = 3.
template <std::unsigned_integral T>
constexpr T ceil_div(T x, T y) {
  return static_cast<T>(x / y + (x % y != 0 ? 1 : 0));
}

/// The value in [lo, hi] nearest to x; lo <= hi (CNV-2).
constexpr int32_t clamp(int32_t x, int32_t lo, int32_t hi) { return x < lo ? lo : x > hi ? hi : x; }

/// The low `bits` bits of `field` read as two's complement (CNV-5); bits in [0, 31], 0 gives 0.
///
/// Example: sign_extend(0b110, 3) = -2.
constexpr int32_t sign_extend(uint32_t field, unsigned bits) {
  if (bits == 0) return 0;
  const uint32_t sign = 1u << (bits - 1);
  const uint32_t low = field & ((sign << 1) - 1u);
  return static_cast<int32_t>(low ^ sign) - static_cast<int32_t>(sign);
}

/// The integer nearest to sum / count, halves up; count >= 1.
///
/// Used by the encoder alone. Example: round_half_up_div(-3, 2) = -1, round_half_up_div(3, 2) = 2.
constexpr int32_t round_half_up_div(int64_t sum, int64_t count) {
  const int64_t doubled = 2 * sum + count;
  const int64_t quotient = doubled / (2 * count);
  const bool below = doubled % (2 * count) < 0;
  return static_cast<int32_t>(below ? quotient - 1 : quotient);
}

}  // namespace hmlfc
