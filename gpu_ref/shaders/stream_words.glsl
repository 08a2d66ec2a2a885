// The bytes of ROOT, GROUP and TILE as words of 32 bits, and bit strings in them (CNV-3, CNV-4).
// The last word is padded.

uint stream_word(uint at) {
  if (!kChunked) return Words(arguments.stream).word[at];
  const uint log2 = arguments.shape.stream_chunk_log2;
  return Chunks(arguments.stream).chunk[at >> log2].word[low_bits(at, log2)];
}

/// The `count` bits, count in [0, 32], that begin with bit `bit` in [0, 31] of word `at`.
uint stream_bits(uint at, uint bit, uint count) {
  if (count == 0u) return 0u;
  uint value = stream_word(at) >> bit;
  if (bit + count > 32u) value |= stream_word(at + 1u) << (32u - bit);
  return low_bits(value, count);
}
