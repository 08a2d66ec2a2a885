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

/// Bits of a sequence of `count` values (BISE-3).
uint bise_bits(Levels levels, uint count) {
  uint bits = levels.plain_bits * count;
  if (levels.digit == DIGIT_TRIT) bits += ceil_div(TRIT_GROUP_BITS * count, TRITS_IN_GROUP);
  if (levels.digit == DIGIT_QUINT) bits += ceil_div(QUINT_GROUP_BITS * count, QUINTS_IN_GROUP);
  return bits;
}

/// The five trits of code T, trit i in bits [4i, 4i + 3] (BISE-8). Every code is valid (BISE-10).
uint trits_of_code(uint T) {
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
  return t0 | t1 << 4 | t2 << 8 | t3 << 12 | t4 << 16;
}

/// The three quints of code Q, quint i in bits [4i, 4i + 3] (BISE-9). Every code is valid (BISE-10).
uint quints_of_code(uint Q) {
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
  return q0 | q1 << 4 | q2 << 8;
}

/// Bits [position, position + count) of a window of 96 bits; count in [0, 31], their end in [0, 96].
uint window_bits(uvec3 window, uint position, uint count) {
  const uint mask = (1u << count) - 1u;
  if (position + count <= 32u) return (window.x >> min(position, 31u)) & mask;
  const bool second = position >= 32u;
  const uint low = position >= 64u ? window.z : second ? window.y : window.x;
  const uint high = second ? window.z : window.y;
  const uint at = position & 31u;
  return ((low >> at) | (at == 0u ? 0u : high << (32u - at))) & mask;
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

/// How the values of a sequence lie in groups: those without digits in fives, too.
struct Grouping {
  uint values;  // of a group
  uint bits;    // of a group
  uint before;  // bits of the code before plain value k, in bits [4k, 4k + 3] (BISE-5, BISE-6)
};

Grouping grouping_of(Levels levels) {
  const uint n = levels.plain_bits;
  if (levels.digit == DIGIT_TRIT) {
    return Grouping(TRITS_IN_GROUP, n * TRITS_IN_GROUP + TRIT_GROUP_BITS, 0x875420u);
  }
  if (levels.digit == DIGIT_QUINT) {
    return Grouping(QUINTS_IN_GROUP, n * QUINTS_IN_GROUP + QUINT_GROUP_BITS, 0x7530u);
  }
  return Grouping(TRITS_IN_GROUP, n * TRITS_IN_GROUP, 0u);
}

/// Group of value i; values are 5 or 3.
uint group_of_value(Grouping grouping, uint i) {
  return grouping.values == QUINTS_IN_GROUP ? i / QUINTS_IN_GROUP : i / TRITS_IN_GROUP;
}

uint code_bits_before(Grouping grouping, uint k) { return (grouping.before >> (4u * k)) & 15u; }

/// One group of a sequence: its bits, and its digits, digit k in bits [4k, 4k + 3].
struct DigitGroup {
  uvec3 window;
  uint digits;
};

/// Group `number` of a sequence of `count` values that begins with bit `bit` of stream word `word`
/// (BISE-4 to BISE-7). The stream holds the whole sequence; a group past its end is 0.
DigitGroup read_group(uint word, uint bit, Levels levels, Grouping grouping, uint count, uint number) {
  const uint length = bise_bits(levels, count);
  const uint start = min(number * grouping.bits, length);
  DigitGroup group;
  group.window = read_window(word, bit, length, start, grouping.bits);
  group.digits = 0u;
  if (levels.digit == DIGIT_NONE) return group;
  const uint n = levels.plain_bits;
  uint code = 0u;
  [[dont_unroll]] for (uint k = 0u; k < grouping.values; ++k) {
    const uint before = code_bits_before(grouping, k);
    const uint bits = code_bits_before(grouping, k + 1u) - before;
    code |= window_bits(group.window, n * (k + 1u) + before, bits) << before;
  }
  group.digits = levels.digit == DIGIT_TRIT ? trits_of_code(code) : quints_of_code(code);
  return group;
}

/// Value k of a group (BISE-2).
uint value_of_group(DigitGroup group, Levels levels, Grouping grouping, uint k) {
  const uint n = levels.plain_bits;
  return ((group.digits >> (4u * k)) & 15u) << n |
         window_bits(group.window, n * k + code_bits_before(grouping, k), n);
}

/// Value i of a sequence of `count` values that begins with bit `bit` of stream word `word`
/// (BISE-11). The stream holds the whole sequence; i < count.
uint bise_value(uint word, uint bit, Levels levels, uint count, uint i) {
  const Grouping grouping = grouping_of(levels);
  const uint number = group_of_value(grouping, i);
  const DigitGroup group = read_group(word, bit, levels, grouping, count, number);
  return value_of_group(group, levels, grouping, i - number * grouping.values);
}
