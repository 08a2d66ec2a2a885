// Roundings and shifts by name (CNV-1, CNV-2, CNV-5, MOT-8). No / or % meets a negative number.

/// Smallest integer not below x / y; y >= 1.
uint ceil_div(uint x, uint y) { return (x + y - 1u) / y; }

/// x / divisor, divisor >= 1; inverse = (2^32 - 1) / divisor. The product of x and it is too small by
/// less than 1.
uint divided(uint x, uint divisor, uint inverse) {
  uint quotient, low;
  umulExtended(x, inverse, quotient, low);
  return quotient + (x - quotient * divisor >= divisor ? 1u : 0u);
}

/// x / 2^k rounded to the nearest integer, halves up; k in [0, 9], |x| < 2^30.
int round_shift(int x, uint k) { return k == 0u ? x : (x + (1 << (k - 1u))) >> k; }

/// The low `bits` bits of `field` in two's complement; bits in [0, 31], 0 gives 0.
int sign_extend(uint field, uint bits) {
  if (bits == 0u) return 0;
  return bitfieldExtract(int(field), 0, int(bits));
}

/// The low `bits` bits of x; bits in [0, 32].
uint low_bits(uint x, uint bits) { return bitfieldExtract(x, 0, int(bits)); }
