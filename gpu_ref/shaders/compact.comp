#version 450
#extension GL_GOOGLE_include_directive : require
// From bits to requests and their slots in the pool: one invocation a word of bits. Requests and
// pages are given away in any order; nothing else depends on it.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_bits.glsl"

void main() {
  const uint at = invocation();
  const uint mode = frame().counters.word[kCountMode];
  if (at >= frame().needed_words) return;
  const uint needed = frame().needed.word[at];
  frame().needed.word[at] = 0u;  // for the next frame
  if (kGeometry) frame().looked_up.word[at] = 0u;
  if (mode == kModeNoRoom) return;
  const uint held = mode == kModeFlush ? 0u : frame().held.word[at];
  frame().held.word[at] = held | needed;
  uint missing = needed & ~held;
  if (missing == 0u) return;
  if (held == 0u) frame().pages.word[at] = atomicAdd(frame().counters.word[kCountNextPage], 1u);
  uint q = atomicAdd(frame().counters.word[kCountRequests], uint(bitCount(missing)));
  const uint first_slot = slot_of_bit(held_blocks(), 32u * at);
  Request request = Request(0u, 0u, 0u);
  uint last = 0u;
  uint left = 0u;  // blocks from that of bit `last` to the end of its row
  for (; missing != 0u; missing &= missing - 1u) {
    const uint in_word = uint(findLSB(missing));
    const uint bit = 32u * at + in_word;
    if (bit - last < left) {
      left -= bit - last;
      request.block += bit - last;
    } else {
      request = request_of_bit(bit);
      left = arguments.shape.planes[plane_of(request)].blocks_x - block_of(request).x;
    }
    last = bit;
    arguments.requests.request[q] = request;
    frame().slots.word[2u * q] = first_slot + in_word;
    frame().slots.word[2u * q + 1u] = bit;
    ++q;
  }
}
