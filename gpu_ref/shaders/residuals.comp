#version 450
#extension GL_GOOGLE_include_directive : require
// The residuals of reference images into the reference area (DEC-4): one invocation for two samples
// of a request of the reference pass.
#include "decode.glsl"
#include "requests.glsl"
#include "stream_words.glsl"
#include "bise.glsl"
#include "block_entry.glsl"
#include "reconstruct.glsl"
#include "reference_samples.glsl"

void main() {
  const uint words_log2 = 2u * arguments.shape.block_log2 - 1u;
  const uint number = invocation();
  const uint q = number >> words_log2;
  if (q >= arguments.request_count) return;
  const Request request = arguments.requests.request[q];
  const PlaneShape plane = arguments.shape.planes[plane_of(request)];
  const BlockEntry entry = read_entry(q);
  const uint i = 2u * (number & low_bits(words_log2));  // position in the block
  if (i == 0u && entry.status != ERROR_OK) atomicAdd(arguments.damage.word[0], 1u);

  const uvec2 place = block_of(request) << arguments.shape.block_log2;
  const uint x = place.x + (i & low_bits(arguments.shape.block_log2));
  const uint y = place.y + (i >> arguments.shape.block_log2);
  if (x >= plane.width || y >= plane.height) return;
  ivec2 samples = ivec2(0);
  if (entry.status != ERROR_OK) {
    samples = ivec2(kErrorSample + int(entry.status));
  } else if (entry.residual) {
    samples = ivec2(residual_value(entry, plane, i), residual_value(entry, plane, i + 1u));
  }
  write_reference_word(entry.references[0].base + y * plane.row_words + (x >> 1),
                       sample_pair(samples));
}
