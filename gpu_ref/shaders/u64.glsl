// Unsigned integers of 64 bits as two words, low word in x: the index has fields of 64 bits (IDX-4,
// IDX-5), tile numbers have 51 (section 11).

uvec2 u64_add(uvec2 a, uvec2 b) {
  uint carry;
  const uint low = uaddCarry(a.x, b.x, carry);
  return uvec2(low, a.y + b.y + carry);
}

/// a - b, a >= b.
uvec2 u64_sub(uvec2 a, uvec2 b) {
  uint borrow;
  const uint low = usubBorrow(a.x, b.x, borrow);
  return uvec2(low, a.y - b.y - borrow);
}

bool u64_less(uvec2 a, uvec2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

uvec2 u64_product(uint a, uint b) {
  uint high, low;
  umulExtended(a, b, high, low);
  return uvec2(low, high);
}

/// a >> k; k in [1, 31].
uvec2 u64_shift_right(uvec2 a, uint k) { return uvec2((a.x >> k) | (a.y << (32u - k)), a.y >> k); }

/// Bit i of a mask; i in [0, 63].
bool has_bit(uvec2 mask, uint i) {
  return ((i < 32u ? mask.x : mask.y) & (1u << (i & 31u))) != 0u;
}

uint popcount(uvec2 mask) { return uint(bitCount(mask.x) + bitCount(mask.y)); }

/// The number of 1 bits below bit i, i in [0, 63] (CNV-6).
uint rank(uvec2 mask, uint i) {
  return i < 32u ? uint(bitCount(low_bits(mask.x, i)))
                 : uint(bitCount(mask.x) + bitCount(low_bits(mask.y, i - 32u)));
}
