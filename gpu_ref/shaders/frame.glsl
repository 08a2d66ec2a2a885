// A frame to be rendered (docs/rendering.md, REC-2) and the buffers of its blocks.
// gpu_ref/frame_shape.hpp has the same members in the same order.

struct FrameRecord {
  int frame_width, frame_height;
  int filter_kind;
  int aperture;
  int n0_hi[3], n0_lo[3];
  int na_hi[3], na_lo[3];
  int nb_hi[3], nb_lo[3];
  int u0, v0, zu, zv;
  int x0, y0, gain, dx, dy;
  int c0, r0, cols, rows;
  int width, height;
};

layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer Frame {
  OutWords needed;       // one bit a block (block_bits.glsl)
  OutWords first_slots;  // by word of `needed`: the request of its lowest bit
  OutWords counters;     // kCount...
  OutWords pixels;       // three samples of 16 bits a pixel, row by row
  uint stop_level;
  uint capacity;         // requests that there is room for
  uint needed_words;
  FrameRecord record;
};

// Words of the counters. Each kernel's dispatch is three of them.
const uint kCountNeeded = 0u;      // blocks that the frame needs
const uint kCountFirstError = 1u;  // the least bit of a block with an error, or all ones
const uint kCountStatus = 2u;      // that block's error
const uint kCountWalk = 3u;
const uint kCountSamples = 6u;
const uint kCountErrors = 9u;
