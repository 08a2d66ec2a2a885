#version 450
#extension GL_GOOGLE_include_directive : require
// From decoded planes to pixels (COL-2, COL-3): one invocation for two pixels of a block.
#include "decode.glsl"
#include "colour.glsl"

/// The area that holds block `number`: the last that begins at it or before it.
ColourArea colour_area_of(uint number) {
  uint low = 0u;
  uint high = arguments.colour_area_count;
  while (high - low > 1u) {
    const uint middle = (low + high) >> 1;
    if (arguments.colour_areas.area[middle].first_block <= number) low = middle; else high = middle;
  }
  return arguments.colour_areas.area[low];
}

/// Sample `at` of request q.
int decoded_sample(uint q, uint at) {
  const uint words_log2 = 2u * arguments.shape.block_log2 - 1u;
  const uint word = arguments.samples.word[(q << words_log2) + (at >> 1)];
  return bitfieldExtract(int(word), int(16u * (at & 1u)), 16);
}

/// The requests of Y, Co and Cg that a block needs, and where in the chroma blocks it lies.
struct Sources {
  uint luma, co, cg;
  uvec2 chroma;  // first chroma sample of the block in its chroma blocks
  uint halved;   // 1 in format 4:2:0
};

Sources sources_of(ColourArea area, uint at) {
  const uvec2 own = uvec2(at % area.columns, at / area.columns);
  const uint halved = arguments.shape.chroma_halved;
  const uvec2 block = uvec2(area.bx, area.by) + own;
  const uvec2 chroma = block >> halved;
  const uint in_area = (chroma.y - area.chroma_by) * area.chroma_columns + chroma.x - area.chroma_bx;
  const uvec2 corner = (block & halved) << (arguments.shape.block_log2 - 1u);
  return Sources(area.luma + at, area.co + in_area, area.cg + in_area, corner, halved);
}

/// The pixel at position (x, y) of the block (COL-2).
ivec3 pixel(Sources sources, uint x, uint y) {
  const uint log2 = arguments.shape.block_log2;
  const uvec2 c = sources.chroma + (uvec2(x, y) >> sources.halved);
  const uint chroma_at = (c.y << log2) + c.x;
  return inverse_colour(ivec3(decoded_sample(sources.luma, (y << log2) + x),
                              decoded_sample(sources.co, chroma_at),
                              decoded_sample(sources.cg, chroma_at)),
                        arguments.shape.depth);
}

void main() {
  const uint log2 = arguments.shape.block_log2;
  const uint words_log2 = 2u * log2 - 1u;
  const uint number = invocation();
  const uint b = number >> words_log2;
  if (b >= arguments.pixel_count) return;
  const ColourArea area = colour_area_of(b);
  const Sources sources = sources_of(area, b - area.first_block);
  uint status = arguments.statuses.word[sources.luma];
  if (status == ERROR_OK) status = arguments.statuses.word[sources.co];
  if (status == ERROR_OK) status = arguments.statuses.word[sources.cg];

  const uint word = number & low_bits(words_log2);
  const uint x = (2u * word) & low_bits(log2);
  const uint y = (2u * word) >> log2;
  ivec3 first = ivec3(0);
  ivec3 second = ivec3(0);
  if (status == ERROR_OK) {
    first = pixel(sources, x, y);
    second = pixel(sources, x + 1u, y);
  }
  for (uint lane = 0u; lane < 3u; ++lane) {
    const uint pair = (uint(first[lane]) & 0xFFFFu) | uint(second[lane]) << 16;
    arguments.pixels.word[((3u * b + lane) << words_log2) + word] = pair;
  }
  if (word == 0u) arguments.pixel_statuses.word[b] = status;
}
