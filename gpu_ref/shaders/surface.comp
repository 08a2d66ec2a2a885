#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
// Where the rays of a frame with geometry meet surfaces: the displacement of each cell (SRF-3), one
// invocation a cell. Counts the blocks whose disparity it looks up (SRF-5).
#include "decode.glsl"
#include "requests.glsl"
#include "u64.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_bits.glsl"
#include "rays.glsl"
#include "cells.glsl"
#include "frame_taps.glsl"

const int kHalfWeight = 32768;
const int kEnoughWeight = 40960;
const int kAgreeing = 1 << 11;  // 8 pixels

/// Blocks looked up by this workgroup.
shared uint looked_up;

/// Counts block `block` of plane Y of view `image` (row, column), once a frame.
void count_looked_up(uvec2 image, uvec2 block) {
  const uint bit = luma_bit(block_bits(), first_bit(image), block);
  const uint mask = 1u << (bit & 31u);
  const uint before = atomicLoad(frame().looked_up.word[bit >> 5], gl_ScopeDevice,
                                 gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
  if ((before & mask) != 0u) return;
  if ((atomicOr(frame().looked_up.word[bit >> 5], mask) & mask) == 0u) atomicAdd(looked_up, 1u);
}

/// The displacement that the block tells which holds pixel `pixel` of view `view` (column, row).
int told_displacement(ivec2 view, ivec2 pixel) {
  const uvec2 image = uvec2(view.y, view.x);
  const uvec2 block = uvec2(pixel) >> arguments.shape.block_log2;
  count_looked_up(image, block);
  const uint number = image.x * arguments.shape.levels[0].cols + image.y;
  const uint word = frame().disparities.word[number * blocks_of_plane(0u) +
                                             block.y * arguments.shape.planes[0].blocks_x + block.x];
  if (word >> 16 == 0u) return 0;
  const int d = bitfieldExtract(int(word), 0, 16);
  const int seen = abs(d) < frame().record.fine ? 0 : d;
  return clamp(seen - frame().record.focus, -(1 << 15), (1 << 15) - 1);
}

/// The pixel nearest to `at`, x(c) or y(r), along an axis.
int nearest_pixel(Axis axis, int at) { return (clamp(at, 0, axis.last_place) + kHalfPixel) >> 12; }

/// What view `view` (column, row) proposes.
int proposal(Axis cols, Axis rows, Ray ray, ivec2 view) {
  int e = 0;
  for (int step = 0; step < 2; ++step) {
    const Ray at = displaced(frame().record, ray, e);
    e = told_displacement(view, ivec2(nearest_pixel(cols, at.x + at.dx * view.x),
                                      nearest_pixel(rows, at.y + at.dy * view.y)));
  }
  return e;
}

int sum(ivec4 weights) { return weights.x + weights.y + weights.z + weights.w; }

/// The median of `proposals`, or 0 where they disagree; `weights`, in [0, 65536], sum to 65536.
int chosen(ivec4 proposals, ivec4 weights) {
  int median = 0x7FFFFFFF;
  for (int i = 0; i < 4; ++i) {
    const ivec4 up_to = weights * ivec4(lessThanEqual(proposals, ivec4(proposals[i])));
    if (weights[i] != 0 && sum(up_to) >= kHalfWeight) median = min(median, proposals[i]);
  }
  const bvec4 agree = lessThanEqual(abs(proposals - median), ivec4(kAgreeing));
  return sum(weights * ivec4(agree)) >= kEnoughWeight ? median : 0;
}

/// Returns E of cell `cell`.
int displacement_of_cell(ivec2 cell) {
  const Ray ray = ray_of_cell(cell);
  if (!ray.inside) return 0;
  const Filter f = filter_of_frame();
  const Axis cols = column_axis();
  const Axis rows = row_axis();
  const ivec2 place = ivec2(view_place(f, cols, ray.u), view_place(f, rows, ray.v));
  const ivec2 first = ivec2(first_view(f, place.x), first_view(f, place.y));
  ivec4 proposals = ivec4(0);
  ivec4 weights = ivec4(0);
  for (int i = 0; i < 4; ++i) {
    const ivec2 number = first + ivec2(i & 1, i >> 1);
    weights[i] = view_weight(f, place.x, number.x) * view_weight(f, place.y, number.y);
    if (weights[i] == 0) continue;
    proposals[i] =
        proposal(cols, rows, ray, clamp(number, ivec2(0), ivec2(cols.last_view, rows.last_view)));
  }
  return chosen(proposals, weights);
}

void main() {
  if (gl_LocalInvocationIndex == 0u) looked_up = 0u;
  barrier();
  const int columns = cells_along(frame().record.frame_width);
  const int cells = columns * cells_along(frame().record.frame_height);
  const int at = int(invocation());
  if (at < cells) {
    frame().displacements.word[at] = uint(displacement_of_cell(ivec2(at % columns, at / columns)));
  }
  barrier();
  if (gl_LocalInvocationIndex == 0u && looked_up != 0u) {
    atomicAdd(frame().counters.word[kCountLookedUp], looked_up);
  }
}
