#version 450
#extension GL_GOOGLE_include_directive : require
// The pixels of a frame (SMP-2, SMP-3): one invocation for two pixels, three words.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_bits.glsl"
#include "rays.glsl"
#include "frame_taps.glsl"
#include "colour.glsl"

/// Sample (x, y) of plane p of the picture in the place of `image`.
int decoded_sample(uvec2 image, uint p, int x, int y) {
  const SamplePlace place = place_of_sample(p, uint(x), uint(y));
  const uint slot = slot_of_bit(bit_of_block(image, p, place.block));
  const uint word = pool_word(word_of_slot(slot, place.at >> 1));
  return bitfieldExtract(int(word), int(16u * (place.at & 1u)), 16);
}

/// pixel(x, y) of SMP-2.
ivec3 pixel(uvec2 image, int x, int y) {
  return inverse_colour(ivec3(decoded_sample(image, 0u, x, y), decoded_sample(image, 1u, x, y),
                              decoded_sample(image, 2u, x, y)),
                        arguments.shape.depth);
}

/// q of SMP-2 in view (row, col). A pixel of weight 0 is not read.
ivec3 view_colour(FrameRecord f, Ray ray, int row, int col) {
  const uvec2 image = shown_image(row, col);
  const AxisTaps x = axis_taps(f, x_in_view(f, ray.xb, col), f.width);
  const AxisTaps y = axis_taps(f, y_in_view(f, ray.yb, row), f.height);
  ivec3 sum = (256 - y.fraction) * (256 - x.fraction) * pixel(image, x.first, y.first);
  if (x.fraction != 0) {
    sum += (256 - y.fraction) * x.fraction * pixel(image, x.first + 1, y.first);
  }
  if (y.fraction != 0) {
    sum += y.fraction * (256 - x.fraction) * pixel(image, x.first, y.first + 1);
  }
  if (x.fraction != 0 && y.fraction != 0) {
    sum += y.fraction * x.fraction * pixel(image, x.first + 1, y.first + 1);
  }
  return (sum + (1 << 11)) >> 12;
}

/// Pixel `number` of the frame, row by row (SMP-3); black outside (RAY-6).
uvec3 frame_pixel(FrameRecord f, uint number) {
  if (number >= uint(f.frame_width) * uint(f.frame_height)) return uvec3(0u);
  const Ray ray = trace(f, int(number % uint(f.frame_width)), int(number / uint(f.frame_width)));
  if (!ray.inside) return uvec3(0u);
  const ViewRange cols = view_range(f, ray.u);
  const ViewRange rows = view_range(f, ray.v);
  uvec3 sum = uvec3(1u << 19);
  for (int i = 0; i < rows.count; ++i) {
    const int row_weight = view_weight(f, rows, rows.first + i);
    if (row_weight == 0) continue;
    const int row = clamp(rows.first + i, 0, f.rows - 1);
    for (int j = 0; j < cols.count; ++j) {
      const int weight = row_weight * view_weight(f, cols, cols.first + j);
      if (weight == 0) continue;
      const int col = clamp(cols.first + j, 0, f.cols - 1);
      sum += uint(weight) * uvec3(view_colour(f, ray, row, col));
    }
  }
  return sum >> 20;
}

/// The counters of the frame to the host, and the error of its first block that has one.
void write_results(uint first_error) {
  for (uint i = 0u; i < kFrameCounters; ++i) {
    frame().results.word[i] = frame().counters.word[i];
  }
  if (first_error != 0xFFFFFFFFu) {
    frame().results.word[kCountStatus] = pool_word(word_of_slot(slot_of_bit(first_error), 0u));
  }
}

void main() {
  const FrameRecord f = frame().record;
  const uint number = invocation();
  const uint first_error = frame().counters.word[kCountFirstError];
  if (number == 0u) write_results(first_error);
  if (2u * number >= uint(f.frame_width) * uint(f.frame_height)) return;
  if (frame().counters.word[kCountMode] == kModeNoRoom || first_error != 0xFFFFFFFFu) return;
  const uvec3 first = frame_pixel(f, 2u * number);
  const uvec3 second = frame_pixel(f, 2u * number + 1u);
  frame().drawn.word[3u * number] = first.x | first.y << 16;
  frame().drawn.word[3u * number + 1u] = first.z | second.x << 16;
  frame().drawn.word[3u * number + 2u] = second.y | second.z << 16;
}
