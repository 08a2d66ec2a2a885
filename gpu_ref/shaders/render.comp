#version 450
#extension GL_GOOGLE_include_directive : require
// The pixels of a frame (SMP-2, SMP-3): one workgroup for 8 x 8 pixels. It fetches the pixels of
// views that they need into shared memory, each once, and draws from there.
#include "decode.glsl"
#include "requests.glsl"
#include "u64.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_bits.glsl"
#include "rays.glsl"
#include "cells.glsl"
#include "frame_taps.glsl"
#include "block_lanes.glsl"
#include "colour.glsl"
#include "pixel_group.glsl"
#include "texels.glsl"

/// Pairs of pixels in shared memory: red and green in a word, then blue. A view's window has rows of
/// pairs that begin at an even column.
const uint kPairsLog2 = 9u;
const uint kPairs = 1u << kPairsLog2;
shared uvec2 fetched[2u * kPairs + 2u];

/// What divides a number of a pair, below kPairs, by `divisor`, in [1, kPairs], as a product: the
/// quotient is too great by less than kPairs / 2^kInverseLog2 <= 1 / divisor.
const uint kInverseLog2 = 2u * kPairsLog2 + 1u;
uint inverse_of(uint divisor) { return ((1u << kInverseLog2) + divisor - 1u) / divisor; }
uint quotient(uint number, uint inverse) { return (number * inverse) >> kInverseLog2; }

/// Pairs of a row of a window, and of a window, with their inverses.
struct WindowSize {
  uint columns, pairs;
  uint column_inverse, pair_inverse;
};

shared WindowSize group_size;  // which one invocation finds

WindowSize window_size() {
  const uint pairs = most_columns * most_rows;
  return WindowSize(most_columns, pairs, inverse_of(most_columns), inverse_of(pairs));
}

/// log2 of the windows of up to `pixels` that have room; less than 0 where one has too little.
int windows_log2(ivec2 pixels) {
  return findMSB(int(kPairs) / (((pixels.x >> 1) + 1) * pixels.y));
}

/// How the pixels of views are found and made.
struct Source {
  BlockBits bits;
  HeldBlocks held;
#ifndef HMLFC_BOUND
  uvec2 pool;
#endif
  uint block_log2, halved;
  int greatest;
};

Source source() {
  return Source(block_bits(), held_blocks(),
#ifndef HMLFC_BOUND
                frame().pool,
#endif
                arguments.shape.block_log2, arguments.shape.chroma_halved, greatest_sample());
}

/// The word of the pool with position `at` of the block of bit `bit`. Where the frame does not need the
/// block it is any word.
uint word_of_block(Source from, uint bit, uint at) {
  const uint slot = slot_of_bit(from.held, bit);
  return pool_word(from.pool, ((slot << (2u * from.block_log2)) + at) >> 1);
}

/// Both samples of chroma of two pixels: those of a word, or with chroma_halved its half `side` twice.
ivec2 chroma_of_pixels(Source from, uint word, uint side) {
  return from.halved == 0u ? samples_of_pair(word)
                           : ivec2(bitfieldExtract(int(word), int(side << 4), 16));
}

/// pixel(x, y) of SMP-2 for x = pixel.x, which is even, and the next, in the image of bit `image`.
ivec3[2] view_pixels(Source from, uint image, uvec2 pixel) {
  const SamplePlace own = place_of_sample(pixel, from.block_log2);
  const ivec2 luma =
      samples_of_pair(word_of_block(from, luma_bit(from.bits, image, own.block), own.at));
  const SamplePlace place = place_of_sample(pixel >> from.halved, from.block_log2);  // COL-3
  const uint bit = chroma_bit(from.bits, image, place.block);
  const uint side = place.at & 1u;
  const ivec2 co = chroma_of_pixels(from, word_of_block(from, bit, place.at), side);
  const ivec2 cg =
      chroma_of_pixels(from, word_of_block(from, bit + from.bits.chroma, place.at), side);
  return ivec3[2](inverse_colour(ivec3(luma.x, co.x, cg.x), from.greatest),
                  inverse_colour(ivec3(luma.y, co.y, cg.y), from.greatest));
}

uvec2 packed(ivec3 colour) { return uvec2(uint(colour.x) | uint(colour.y) << 16, uint(colour.z)); }
ivec3 unpacked(uvec2 colour) { return ivec3(colour.x & 0xFFFFu, colour.x >> 16, colour.y); }

/// Fetches the windows of pass `pass`.
void fetch(Passes passes, uint pass, WindowSize size) {
  Source from = source();
  const uint end = windows_of_pass(passes, pass) * size.pairs;
  for (uint i = gl_LocalInvocationIndex; i < end; i += gl_WorkGroupSize.x) {
    const uint window = quotient(i, size.pair_inverse);
    uvec2 lines;
    if (!lines_of_window(passes, pass, window, lines)) continue;
    const Line col = window_cols[lines.x];
    const Line row = window_rows[lines.y];
    const uint in_window = i - window * size.pairs;
    const uint window_row = quotient(in_window, size.column_inverse);
    const int x = (col.first & ~1) + 2 * int(in_window - window_row * size.columns);
    const int y = row.first + int(window_row);
    if (x > col.last || y > row.last) continue;
    const ivec3 pixels[2] = view_pixels(from, col.bit + row.bit, uvec2(x, y));
    fetched[2u * i] = packed(pixels[0]);
    fetched[2u * i + 1u] = packed(pixels[1]);
  }
}

/// A column or row of views as a pixel takes it: its part of the place in `fetched`, and the fraction.
struct TapLine {
  int weight;
  uint first;
  int fraction;
};

TapLine tap_col(WindowSize size, PixelLine line) {
  const int column = first_pixel(line.tap) - (window_cols[line.line].first & ~1);
  return TapLine(line.weight, 2u * line.window * size.pairs + uint(column), line.tap & 255);
}
TapLine tap_row(WindowSize size, PixelLine line) {
  const int row = first_pixel(line.tap) - window_rows[line.line].first;
  return TapLine(line.weight, 2u * (line.window * size.pairs + uint(row) * size.columns),
                 line.tap & 255);
}

/// The sum of four taps of SMP-2 of samples of 8 bits: products with a fraction fit 16 bits, so red and
/// green share a word.
uvec3 sum_of_bytes(uvec2 upper[2], uvec2 lower[2], uint x, uint y) {
  const uvec2 above = (256u - x) * upper[0] + x * upper[1];
  const uvec2 below = (256u - x) * lower[0] + x * lower[1];
  return (256u - y) * uvec3(unpacked(above)) + y * uvec3(unpacked(below));
}

/// The same sum for samples of up to 12 bits.
uvec3 sum_of_taps(uvec2 upper[2], uvec2 lower[2], int x, int y) {
  const int both = x * y;
  const int right = (x << 8) - both;
  const int below = (y << 8) - both;
  return uvec3((65536 - right - below - both) * unpacked(upper[0]) + right * unpacked(upper[1]) +
               below * unpacked(lower[0]) + both * unpacked(lower[1]));
}

/// What a view gives a pixel: its weight times q of SMP-2. A pixel of weight 0 may have any value.
uvec3 view_colour(WindowSize size, bool bytes, TapLine col, TapLine row) {
  const int weight = col.weight * row.weight;
  if (weight == 0) return uvec3(0u);
  const uint first = row.first + col.first;
  if ((col.fraction | row.fraction) == 0) return uint(weight << 4) * uvec3(unpacked(fetched[first]));
  const uint next = min(first + 2u * size.columns, 2u * kPairs);  // after the last window the weight is 0
  const uvec2 upper[2] = uvec2[2](fetched[first], fetched[first + 1u]);
  const uvec2 lower[2] = uvec2[2](fetched[next], fetched[next + 1u]);
  const uvec3 sum = bytes ? sum_of_bytes(upper, lower, uint(col.fraction), uint(row.fraction))
                          : sum_of_taps(upper, lower, col.fraction, row.fraction);
  return uint(weight) * ((sum + (1u << 11)) >> 12);
}

/// What the views of pass `pass` give the invocation's pixel, two rows of views at a time.
uvec3 pass_colour(Filter f, Axis cols, Axis rows, Passes passes, Ray ray, uint pass,
                  WindowSize size) {
  uvec3 sum = uvec3(0u);
  const bool bytes = arguments.shape.depth == 8u;
  const PixelRange range = range_of_pass(f, passes, pass);
  for (int i = range.first.y; i < range.end.y; i += 2) {
    const TapLine row0 = tap_row(size, pixel_row(f, rows, passes, ray, pass, range, i));
    const TapLine row1 =
        tap_row(size, pixel_row(f, rows, passes, ray, pass, range, i + 1));
    [[dont_unroll]] for (int j = range.first.x; j < range.end.x; ++j) {
      const TapLine col = tap_col(size, pixel_col(f, cols, passes, ray, range, j));
      sum += view_colour(size, bytes, col, row0) + view_colour(size, bytes, col, row1);
    }
  }
  return sum;
}

/// The pixel of the invocation, which all of a workgroup call (SMP-3); black outside (RAY-6).
uvec3 frame_pixel(ivec2 at) {
  const Filter f = filter_of_frame();
  const Axis cols = column_axis();
  const Axis rows = row_axis();
  Ray ray = read_ray();
  const int e = ray.inside ? displacement_at(at) : 0;
  find_bounds(ray, e);
  if (kGeometry) ray = displaced(frame().record, ray, e);
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    group_passes = passes_of_group(f, cols, rows, windows_log2(most_pixels_of_group()));
  }
  barrier();
  const Passes passes = group_passes;
  uvec3 sum = uvec3(1u << 19);
  for (uint pass = 0u; pass < passes.count; ++pass) {
    write_lines(f, cols, rows, passes, ray, pass);
    barrier();
    if (gl_LocalInvocationIndex == 0u) group_size = window_size();
    barrier();
    const WindowSize size = group_size;
    fetch(passes, pass, size);
    barrier();
    if (ray.inside) sum += pass_colour(f, cols, rows, passes, ray, pass, size);
    barrier();
  }
  return ray.inside ? sum >> 20 : uvec3(0u);
}

/// Writes pixels of 48 bits, two in three words, in rows of an even number of pixels. The invocation of
/// an even column writes its own and the next one's, which it finds in shared memory.
void write_pixel(ivec2 at, uvec3 pixel) {
  const uint lane = gl_LocalInvocationIndex;
  fetched[lane] = packed(ivec3(pixel));
  barrier();
  const ivec2 size = ivec2(frame().record.frame_width, frame().record.frame_height);
  if ((at.x & 1) != 0 || at.x >= size.x || at.y >= size.y) return;
  const uvec2 next = fetched[lane + 1u];
  const uint pair = (uint(at.y) * uint(size.x + 1 >> 1)) + (uint(at.x) >> 1);
  frame().drawn.word[3u * pair] = fetched[lane].x;
  frame().drawn.word[3u * pair + 1u] = pixel.z | next.x << 16;
  frame().drawn.word[3u * pair + 2u] = next.x >> 16 | next.y << 16;
}

/// With kTexels: the texels are in rows without gaps, all 0 where no frame is drawn.
void write_frame_texel(ivec2 at, uvec3 pixel, bool drawn) {
  const ivec2 size = ivec2(frame().record.frame_width, frame().record.frame_height);
  if (at.x >= size.x || at.y >= size.y) return;
  const uint texel = uint(at.y) * uint(size.x) + uint(at.x);
  const uvec2 words = words_of_texel(ivec3(pixel), drawn);
  if (arguments.shape.depth == 8u) {
    frame().drawn.word[texel] = words.x;
  } else {
    frame().drawn.word[2u * texel] = words.x;
    frame().drawn.word[2u * texel + 1u] = words.y;
  }
}

/// The counters of the frame to the host, and the error of its first block that has one.
void write_results(uint first_error) {
  for (uint i = 0u; i < kFrameCounters; ++i) {
    frame().results.word[i] = frame().counters.word[i];
  }
  if (first_error != kNoError) {
    const uint slot = slot_of_bit(held_blocks(), first_error);
    frame().results.word[kCountStatus] = pool_word(frame().pool, word_of_slot(slot, 0u));
  }
}

void main() {
  const uint first_error = frame().counters.word[kCountFirstError];
  const ivec2 at = pixel_of_invocation();
  if (at == ivec2(0)) write_results(first_error);
  const bool drawn = frame().counters.word[kCountMode] != kModeNoRoom && first_error == kNoError;
  const uvec3 pixel = drawn ? frame_pixel(at) : uvec3(0u);
  if (kTexels) {
    write_frame_texel(at, pixel, drawn);
  } else if (drawn) {
    write_pixel(at, pixel);
  }
}
