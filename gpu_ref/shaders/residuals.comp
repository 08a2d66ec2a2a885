#version 450
#extension GL_GOOGLE_include_directive : require
// The residuals of reference images into the reference area (DEC-4): one invocation for some
// samples of a request of the reference pass.
#include "decode.glsl"
#include "requests.glsl"
#include "stream_words.glsl"
#include "block_lanes.glsl"
#include "bise.glsl"
#include "block_entry.glsl"
#include "reconstruct.glsl"
#include "reference_samples.glsl"

void main() {
  const uint number = invocation();
  const uint q = number >> lanes_of_block_log2();
  if (q >= arguments.request_count) return;
  const Request request = arguments.requests.request[q];
  const PlaneShape plane = arguments.shape.planes[plane_of(request)];
  const KeptEntry entry = read_entry(q);
  const uint status = status_of(entry);
  const uint lane = low_bits(number, lanes_of_block_log2());
  if (lane == 0u && status != ERROR_OK) atomicAdd(arguments.damage.word[0], 1u);
  const uint first = lane * SAMPLES_OF_LANE;
  uvec4 pairs = uvec4(0u);
  if (status != ERROR_OK) {
    pairs = uvec4(sample_pair(ivec2(kErrorSample + int(status))));
  } else if (has_residual(entry)) {
    pairs = residual_pairs(entry, plane, first);
  }
  for (uint k = 0u; k < 1u << words_of_lane_log2(); ++k) {
    const uvec2 at = (block_of(request) << arguments.shape.block_log2) + place_in_block(first + 2u * k);
    if (at.x < plane.width && at.y < plane.height) {
      write_reference_word(base_of(entry) + at.y * plane.row_words + (at.x >> 1), pairs.x);
    }
    pairs = pairs.yzwx;
  }
}
