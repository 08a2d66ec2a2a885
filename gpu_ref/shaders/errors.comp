#version 450
#extension GL_GOOGLE_include_directive : require
// The first needed block that does not decode (NED-2): one invocation a request.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_bits.glsl"

void main() {
  const uint q = invocation();
  if (q >= request_count()) return;
  if (arguments.statuses.word[q] == ERROR_OK) return;
  const Request request = arguments.requests.request[q];
  const uint bit = bit_of_block(image_of(request), plane_of(request), block_of(request));
  atomicMin(frame().counters.word[kCountFirstError], bit);
}
