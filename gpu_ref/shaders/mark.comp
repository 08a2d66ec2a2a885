#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
// The blocks that a frame needs (NED-1), and what it therefore decodes: one invocation a pixel.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_bits.glsl"
#include "rays.glsl"
#include "frame_taps.glsl"
#include "frame_plan.glsl"

/// Most bits are set already: an atomic operation only where that is not so.
void mark(uint bit) {
  const uint mask = 1u << (bit & 31u);
  const uint marked = atomicLoad(frame().needed.word[bit >> 5], gl_ScopeDevice,
                                 gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
  if ((marked & mask) == 0u) {
    count_marked(bit >> 5, atomicOr(frame().needed.word[bit >> 5], mask), mask);
  }
}

void mark_pixel(uvec2 image, int x, int y) {
  for (uint p = 0u; p < 3u; ++p) {
    mark(bit_of_block(image, p, place_of_sample(p, uint(x), uint(y)).block));
  }
}

void mark_view(FrameRecord f, Ray ray, int row, int col) {
  const uvec2 image = shown_image(row, col);
  const AxisTaps x = axis_taps(f, x_in_view(f, ray.xb, col), f.width);
  const AxisTaps y = axis_taps(f, y_in_view(f, ray.yb, row), f.height);
  const int last_x = x.first + (x.fraction != 0 ? 1 : 0);
  const int last_y = y.first + (y.fraction != 0 ? 1 : 0);
  for (int py = y.first; py <= last_y; ++py) {
    for (int px = x.first; px <= last_x; ++px) mark_pixel(image, px, py);
  }
}

void mark_pixel_of_frame(FrameRecord f, uint number) {
  if (number >= uint(f.frame_width) * uint(f.frame_height)) return;
  const Ray ray = trace(f, int(number % uint(f.frame_width)), int(number / uint(f.frame_width)));
  if (!ray.inside) return;
  const ViewRange cols = view_range(f, ray.u);
  const ViewRange rows = view_range(f, ray.v);
  for (int i = 0; i < rows.count; ++i) {
    if (view_weight(f, rows, rows.first + i) == 0) continue;
    for (int j = 0; j < cols.count; ++j) {
      if (view_weight(f, cols, cols.first + j) == 0) continue;
      mark_view(f, ray, clamp(rows.first + i, 0, f.rows - 1), clamp(cols.first + j, 0, f.cols - 1));
    }
  }
}

void main() {
  begin_marking();
  mark_pixel_of_frame(frame().record, invocation());
  end_marking();
}
