// A block's samples by invocations: each takes 8 of them one after the other, or all of a block of
// 2 x 2, two in a word.

const uint SAMPLES_OF_LANE = 8u;

uint words_of_block_log2() { return 2u * arguments.shape.block_log2 - 1u; }

/// log2 of the words of an invocation, 1 or 2, and of the invocations of a block.
uint words_of_lane_log2() { return min(words_of_block_log2(), 2u); }
uint lanes_of_block_log2() { return words_of_block_log2() - words_of_lane_log2(); }

/// Samples 2k and 2k + 1 as one word.
uint sample_pair(ivec2 samples) { return uint(bitfieldInsert(samples.x, samples.y, 16, 16)); }
ivec2 samples_of_pair(uint pair) { return ivec2(bitfieldExtract(int(pair), 0, 16), int(pair) >> 16); }

/// Column and row in its block of sample i.
uvec2 place_in_block(uint i) {
  const uint log2 = arguments.shape.block_log2;
  return uvec2(low_bits(i, log2), i >> log2);
}
