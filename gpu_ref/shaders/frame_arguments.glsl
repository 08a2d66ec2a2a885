// The frame of a rendering kernel, which Arguments::frame points to, and the pool of its blocks.
// HMLFC_BOUND: for WGSL, where addresses are bindings, no address is a value.

#ifdef HMLFC_BOUND
#define frame() Frame(arguments.frame)
#else
Frame frame() { return Frame(arguments.frame); }
#endif

/// The requests of this dispatch: the host says how many, or with kCounted frame_plan.glsl does.
layout(constant_id = 3) const bool kCounted = false;

/// The pool is in more than one buffer.
layout(constant_id = 4) const bool kPoolChunked = false;

/// The frame has geometry (docs/rendering.md, section 9).
layout(constant_id = 5) const bool kGeometry = false;

uint request_count() {
  return kCounted ? frame().counters.word[kCountDecoded] : arguments.request_count;
}

/// Word `word` of the samples in a slot of the pool, as a word of the whole pool.
uint word_of_slot(uint slot, uint word) {
  return (slot << (2u * arguments.shape.block_log2 - 1u)) + word;
}

/// Word `at` of the pool at address `pool`.
#ifdef HMLFC_BOUND
uint bound_pool_word(uint at) { return OutWords(frame().pool).word[at]; }
#define pool_word(pool, at) bound_pool_word(at)
#else
uint pool_word(uvec2 pool, uint at) {
  if (!kPoolChunked) return OutWords(pool).word[at];
  const uint log2 = frame().pool_chunk_log2;
  return OutChunks(pool).chunk[at >> log2].word[low_bits(at, log2)];
}
#endif

void write_pool_word(uint at, uint value) {
  if (kPoolChunked) {
    const uint log2 = frame().pool_chunk_log2;
    OutChunks(frame().pool).chunk[at >> log2].word[low_bits(at, log2)] = value;
  } else {
    OutWords(frame().pool).word[at] = value;
  }
}

/// The word for word `word` of the samples of request q.
uint word_of_request(uint q, uint word) {
  return word_of_slot(kCounted ? frame().slots.word[2u * q] : q, word);
}

void write_samples(uint at, uint samples) {
  if (kCounted) {
    write_pool_word(at, samples);
  } else {
    arguments.samples.word[at] = samples;
  }
}
