// Bounded integer sequences (section 5.1).

/// A level count N and its parts; a value is digit * 2^plain_bits + plain (BISE-2).
struct Levels {
  uint count;
  uint plain_bits;
  uint digit;  // DIGIT_NONE, DIGIT_TRIT or DIGIT_QUINT
};

/// The level count of `code` in [0, MAX_LEVEL_CODE] (BISE-1).
Levels levels_of_code(uint code) {
  const uint entry = kLevels[code];
  return Levels(entry & 0xFFFFu, (entry >> 16) & 0xFu, entry >> 20);
}

/// Bits of T and of Q that follow plain value k of a digit group: 2, 2, 1, 2, 1 and 3, 2, 2 (BISE-5,
/// BISE-6).
uint trit_code_bits(uint k) { return (0x12122u >> (4u * k)) & 15u; }
uint quint_code_bits(uint k) { return (0x223u >> (4u * k)) & 15u; }

/// Bits of a sequence of `count` values (BISE-3).
uint bise_bits(Levels levels, uint count) {
  uint bits = levels.plain_bits * count;
  if (levels.digit == DIGIT_TRIT) bits += ceil_div(TRIT_GROUP_BITS * count, TRITS_IN_GROUP);
  if (levels.digit == DIGIT_QUINT) bits += ceil_div(QUINT_GROUP_BITS * count, QUINTS_IN_GROUP);
  return bits;
}

/// Trit i in [0, 4] of code T (BISE-8). Every code is valid (BISE-10).
uint trit_of_code(uint T, uint i) {
  uint C, t4, t3;
  if (((T >> 2) & 7u) == 7u) {
    C = ((T >> 3) & 0x1Cu) | (T & 3u);
    t4 = 2u;
    t3 = 2u;
  } else {
    C = T & 31u;
    const bool two = ((T >> 5) & 3u) == 3u;
    t4 = two ? 2u : T >> 7;
    t3 = two ? T >> 7 : (T >> 5) & 3u;
  }
  uint t2, t1, t0;
  const uint c3 = (C >> 3) & 1u;
  if ((C & 3u) == 3u) {
    t2 = 2u;
    t1 = C >> 4;
    t0 = (c3 << 1) | ((C >> 2) & 1u & ~c3);
  } else if (((C >> 2) & 3u) == 3u) {
    t2 = 2u;
    t1 = 2u;
    t0 = C & 3u;
  } else {
    t2 = C >> 4;
    t1 = (C >> 2) & 3u;
    t0 = (C & 2u) | (C & 1u & ~(C >> 1));
  }
  return i < 2u ? (i == 0u ? t0 : t1) : i == 2u ? t2 : i == 3u ? t3 : t4;
}

/// Quint i in [0, 2] of code Q (BISE-9). Every code is valid (BISE-10).
uint quint_of_code(uint Q, uint i) {
  uint q2, q1, q0;
  const uint low = Q & 1u;
  if (((Q >> 1) & 3u) == 3u && (Q >> 5) == 0u) {
    q2 = (low << 2) | ((((Q >> 4) & 1u) & ~low) << 1) | (((Q >> 3) & 1u) & ~low);
    q1 = 4u;
    q0 = 4u;
  } else {
    uint C;
    if (((Q >> 1) & 3u) == 3u) {
      q2 = 4u;
      C = (((Q >> 3) & 3u) << 3) | ((~(Q >> 5) & 3u) << 1) | low;
    } else {
      q2 = (Q >> 5) & 3u;
      C = Q & 31u;
    }
    const bool five = (C & 7u) == 5u;
    q1 = five ? 4u : C >> 3;
    q0 = five ? C >> 3 : C & 7u;
  }
  return i == 0u ? q0 : i == 1u ? q1 : q2;
}

/// Bits [position, position + count) of a window of 96 bits; count in [0, 32], their end in [0, 96].
uint window_bits(uvec3 window, uint position, uint count) {
  const bool second = position >= 32u;
  const uint low = position >= 64u ? window.z : second ? window.y : window.x;
  const uint high = second ? window.z : window.y;
  const uint at = position & 31u;
  const uint value = (low >> at) | (at == 0u ? 0u : high << (32u - at));
  return value & low_bits(count);
}

/// The `count` bits, count in [0, 96], from bit `start` of the bit string on that begins with bit
/// `bit` of stream word `word` and has `length` bits, start <= length; those past its end are 0.
uvec3 read_window(uint word, uint bit, uint length, uint start, uint count) {
  const uint there = min(count, length - start);
  const uint at = bit + start;
  uvec3 window = uvec3(0u);
  window.x = stream_bits(word + (at >> 5), at & 31u, min(there, 32u));
  if (there > 32u) window.y = stream_bits(word + (at >> 5) + 1u, at & 31u, min(there - 32u, 32u));
  if (there > 64u) window.z = stream_bits(word + (at >> 5) + 2u, at & 31u, there - 64u);
  return window;
}

/// Value i of a sequence of `count` values that begins with bit `bit` of stream word `word`
/// (BISE-4 to BISE-7, BISE-11). The stream holds the whole sequence; i < count.
uint bise_value(uint word, uint bit, Levels levels, uint count, uint i) {
  const uint n = levels.plain_bits;
  const uint length = bise_bits(levels, count);
  if (levels.digit == DIGIT_NONE) return read_window(word, bit, length, n * i, n).x;
  const bool trits = levels.digit == DIGIT_TRIT;
  const uint in_group = trits ? TRITS_IN_GROUP : QUINTS_IN_GROUP;
  const uint group_bits = n * in_group + (trits ? TRIT_GROUP_BITS : QUINT_GROUP_BITS);
  const uint digit_group = i / in_group;
  const uint own = i - digit_group * in_group;
  const uvec3 window = read_window(word, bit, length, digit_group * group_bits, group_bits);
  uint code = 0u;
  uint plain_at = 0u;
  uint before = 0u;  // bits of the code that have been read
  for (uint k = 0u; k < in_group; ++k) {
    const uint at = n * k + before;
    if (k == own) plain_at = at;
    const uint bits = trits ? trit_code_bits(k) : quint_code_bits(k);
    code |= window_bits(window, at + n, bits) << before;
    before += bits;
  }
  const uint digit = trits ? trit_of_code(code, own) : quint_of_code(code, own);
  return (digit << n) | window_bits(window, plain_at, n);
}
