#version 450
#extension GL_GOOGLE_include_directive : require
// From bits to requests: one invocation a word of bits.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_bits.glsl"

void main() {
  const uint at = invocation();
  if (at >= frame().needed_words) return;
  uint bits = frame().needed.word[at];
  if (bits == 0u) return;
  uint slot = atomicAdd(frame().counters.word[kCountNeeded], uint(bitCount(bits)));
  frame().first_slots.word[at] = slot;
  for (; bits != 0u; bits &= bits - 1u) {
    const uint bit = 32u * at + uint(findLSB(bits));
    if (slot < frame().capacity) arguments.requests.request[slot] = request_of_bit(bit);
    ++slot;
  }
}
