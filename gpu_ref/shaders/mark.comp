#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
// The blocks that a frame needs (NED-1), and what it therefore decodes: one workgroup for 8 x 8
// pixels. In each view they need blocks of a small window, which has bits in shared memory; a row of
// those is marked at once.
#include "decode.glsl"
#include "requests.glsl"
#include "u64.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_bits.glsl"
#include "rays.glsl"
#include "cells.glsl"
#include "frame_taps.glsl"
#include "pixel_group.glsl"
#include "block_lanes.glsl"
#include "frame_plan.glsl"

/// A window has 8 x 8 blocks of plane Y, 8 bits for each row. Blocks of chroma planes are needed that
/// hold samples of the same pixels: those below blocks of plane Y (COL-3).
const uint kWindow = 8u;
shared uint window_bits[kWindows * kWindow];

/// Sets the bits `bits` of word `word`. Most are set already: only the others cost an atomic operation.
void mark_word(uint word, uint bits) {
  const uint marked = atomicLoad(frame().needed.word[word], gl_ScopeDevice,
                                 gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
  if ((bits & ~marked) != 0u) {
    count_marked(word, atomicOr(frame().needed.word[word], bits), bits);
  }
}

/// Sets up to 8 block bits from index `bit` on by the mask `row`.
void mark_row(uint bit, uint row) {
  const uint at = bit & 31u;
  mark_word(bit >> 5, row << at);
  if (at > 24u && row >> (32u - at) != 0u) mark_word((bit >> 5) + 1u, row >> (32u - at));
}

/// Row y of window `window`, as bits from the column on that is a whole number of chroma blocks.
uint even_row(uint window, uint y, uint odd) {
  return y < kWindow ? window_bits[window * kWindow + y] << odd : 0u;
}

/// One bit for each two of the 10 bits of `row`.
uint halved_row(uint row) {
  const uint pairs = (row | row >> 1) & 0x155u;
  const uint fours = (pairs | pairs >> 1) & 0x333u;
  return (fours & 3u) | ((fours >> 2) & 0xCu) | ((fours >> 4) & 0x30u);
}

/// Marks the blocks of row `y` of a window, and those of the chroma planes below it: where they are
/// halved, with the next row, once for both.
void mark_blocks(uvec2 lines, uint window, uint y) {
  const Line col = window_cols[lines.x];
  const Line line = window_rows[lines.y];
  const uint image = col.bit + line.bit;
  const uvec2 corner = uvec2(col.first, line.first) >> arguments.shape.block_log2;
  const uvec2 first = corner + uvec2(0u, y);
  uint row = window_bits[window * kWindow + y];
  const BlockBits bits = block_bits();
  if (row != 0u) mark_row(luma_bit(bits, image, first), row);
  uvec2 chroma = first;
  if (arguments.shape.chroma_halved != 0u) {
    const uint odd = corner.x & 1u;
    if ((first.y & 1u) != 0u && y != 0u) return;  // with the row before
    row = even_row(window, y, odd);
    if ((first.y & 1u) == 0u) row |= even_row(window, y + 1u, odd);
    row = halved_row(row);
    chroma >>= 1;
  }
  if (row == 0u) return;
  const uint bit = chroma_bit(bits, image, chroma);
  mark_row(bit, row);
  mark_row(bit + bits.chroma, row);
}

/// The first and the last block of plane Y that a pixel needs along an axis, from the first of the
/// window that begins with pixel `window_first` on.
uvec2 blocks_of_line(PixelLine line, int window_first) {
  const uint log2 = arguments.shape.block_log2;
  return (uvec2(first_pixel(line.tap), last_pixel(line.tap)) >> log2) - (uint(window_first) >> log2);
}

/// What a pixel needs of a column of views: the first word of the windows in it, and the bits.
struct BlockCol {
  bool needed;
  uint word, bits;
};

BlockCol block_col(PixelLine line) {
  const uvec2 blocks = blocks_of_line(line, window_cols[line.line].first);
  return BlockCol(line.weight != 0, line.window * kWindow, (2u << blocks.y) - (1u << blocks.x));
}

/// What a pixel needs of a row of views: the words of the first and the last row of blocks.
struct BlockRow {
  bool needed;
  uint first, last;
};

BlockRow block_row(PixelLine line) {
  const uvec2 blocks =
      blocks_of_line(line, window_rows[line.line].first) + line.window * kWindow;
  return BlockRow(line.weight != 0, blocks.x, blocks.y);
}

/// Sets the bits of what a pixel needs of one view: one or two rows.
void mark_view(BlockCol col, BlockRow row) {
  if (!(col.needed && row.needed)) return;
  atomicOr(window_bits[col.word + row.first], col.bits);
  if (row.last != row.first) atomicOr(window_bits[col.word + row.last], col.bits);
}

/// Marks what the invocation's pixel needs in pass `pass`, 2 x 2 views at a time.
void mark_pixel(Filter f, Axis cols, Axis rows, Passes passes, Ray ray, uint pass) {
  const PixelRange range = range_of_pass(f, passes, pass);
  for (int i = range.first.y; i < range.end.y; i += 2) {
    const BlockRow row0 = block_row(pixel_row(f, rows, passes, ray, pass, range, i));
    const BlockRow row1 = block_row(pixel_row(f, rows, passes, ray, pass, range, i + 1));
    for (int j = range.first.x; j < range.end.x; j += 2) {
      const BlockCol col0 = block_col(pixel_col(f, cols, passes, ray, range, j));
      const BlockCol col1 = block_col(pixel_col(f, cols, passes, ray, range, j + 1));
      mark_view(col0, row0);
      mark_view(col1, row0);
      mark_view(col0, row1);
      mark_view(col1, row1);
    }
  }
}

void main() {
  begin_marking();
  const uint lane = gl_LocalInvocationIndex;
  const Filter f = filter_of_frame();
  const Axis cols = column_axis();
  const Axis rows = row_axis();
  const ivec2 at = pixel_of_invocation();
  Ray ray = ray_of_pixel(at);
  write_ray(ray);
  const int e = ray.inside ? displacement_at(at) : 0;
  find_bounds(ray, e);
  if (kGeometry) ray = displaced(frame().record, ray, e);
  barrier();
  if (lane == 0u) {
    const ivec2 pixels = most_pixels_of_group();
    const ivec2 blocks = (pixels >> arguments.shape.block_log2) + 2;
    const bool room = max(blocks.x, blocks.y) <= int(kWindow);
    group_passes = passes_of_group(f, cols, rows, room ? kWindowsLog2 : -1);
  }
  barrier();
  const Passes passes = group_passes;
  for (uint pass = 0u; pass < passes.count; ++pass) {
    const uint windows = windows_of_pass(passes, pass);
    write_lines(f, cols, rows, passes, ray, pass);
    for (uint i = lane; i < windows * kWindow; i += gl_WorkGroupSize.x) window_bits[i] = 0u;
    barrier();
    if (ray.inside) mark_pixel(f, cols, rows, passes, ray, pass);
    barrier();
    for (uint i = lane; i < windows * kWindow; i += gl_WorkGroupSize.x) {
      uvec2 lines;
      if (!lines_of_window(passes, pass, i / kWindow, lines)) continue;
      mark_blocks(lines, i / kWindow, i % kWindow);
    }
    barrier();
  }
  end_marking();
}
