#version 450
#extension GL_GOOGLE_include_directive : require
// How many blocks a frame needs, and how many of them are not held: one invocation a word of bits.
#include "decode.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"

void main() {
  const uint at = invocation();
  if (at >= frame().needed_words) return;
  const uint needed = frame().needed.word[at];
  if (needed == 0u) return;
  atomicAdd(frame().counters.word[kCountNeeded], uint(bitCount(needed)));
  atomicAdd(frame().counters.word[kCountNeededPages], 1u);
  const uint held = frame().held.word[at];
  if ((needed & ~held) == 0u) return;
  atomicAdd(frame().counters.word[kCountMissing], uint(bitCount(needed & ~held)));
  if (held == 0u) atomicAdd(frame().counters.word[kCountMissingPages], 1u);
}
