#version 450
#extension GL_GOOGLE_include_directive : require
// From decoded planes to pixels (COL-2, COL-3): one invocation for up to 8 pixels of a
// block.
#include "decode.glsl"
#include "block_lanes.glsl"
#include "colour.glsl"
#include "texels.glsl"

#define AREA ColourArea
#define AREAS arguments.colour_areas
#define FIRST first_block
#include "area_search.glsl"

/// The requests of Y, Co and Cg that a block needs, and where in the chroma blocks it lies.
struct Sources {
  uint luma, co, cg;  // requests
  uint words_log2;    // of the words of each
  uvec2 chroma;  // first chroma sample of the block in its chroma blocks
  uint halved;   // 1 in format 4:2:0
  int greatest;
};

Sources sources_of(ColourArea area, uint at) {
  const uint row = at / area.columns;
  const uvec2 own = uvec2(at - row * area.columns, row);
  const uint halved = arguments.shape.chroma_halved;
  const uvec2 block = uvec2(area.bx, area.by) + own;
  const uvec2 chroma = block >> halved;
  const uint in_area = (chroma.y - area.chroma_by) * area.chroma_columns + chroma.x - area.chroma_bx;
  const uvec2 corner = (block & halved) << (arguments.shape.block_log2 - 1u);
  return Sources(area.luma + at, area.co + in_area, area.cg + in_area, words_of_block_log2(), corner,
                 halved, greatest_sample());
}

/// The word with sample `at` of request q.
uint decoded_word(Sources sources, uint q, uint at) {
  return arguments.samples.word[(q << sources.words_log2) + (at >> 1)];
}

/// Chroma of two pixels, from sample `at` of request q on; with chroma_halved it is the same of both.
ivec2 chroma_pair(Sources sources, uint q, uint at) {
  const uint word = decoded_word(sources, q, at);
  return sources.halved == 0u ? samples_of_pair(word)
                              : ivec2(bitfieldExtract(int(word), int((at & 1u) << 4), 16));
}

/// The pixels at positions i, which is even, and i + 1 of the block (COL-2).
ivec3[2] pixels(Sources sources, uint i) {
  const uvec2 c = sources.chroma + (place_in_block(i) >> sources.halved);
  const uint chroma_at = (c.y << arguments.shape.block_log2) + c.x;
  const ivec2 luma = samples_of_pair(decoded_word(sources, sources.luma, i));
  const ivec2 co = chroma_pair(sources, sources.co, chroma_at);
  const ivec2 cg = chroma_pair(sources, sources.cg, chroma_at);
  return ivec3[2](inverse_colour(ivec3(luma.x, co.x, cg.x), sources.greatest),
                  inverse_colour(ivec3(luma.y, co.y, cg.y), sources.greatest));
}

void main() {
  const uint number = invocation();
  const uint b = number >> lanes_of_block_log2();
  if (b >= arguments.pixel_count) return;
  const ColourArea area = area_of(b, arguments.colour_area_count);
  const Sources sources = sources_of(area, b - area.first_block);
  uint status = arguments.statuses.word[sources.luma];
  if (status == ERROR_OK) status = arguments.statuses.word[sources.co];
  if (status == ERROR_OK) status = arguments.statuses.word[sources.cg];

  const uint lane = low_bits(number, lanes_of_block_log2());
  const uint words = 1u << words_of_lane_log2();
  const uint first_word = ((3u * b) << sources.words_log2) + (lane << 2);
  for (uint k = 0u; k < words; ++k) {
    const uint word = (lane << 2) + k;
    ivec3 both[2] = ivec3[2](ivec3(0), ivec3(0));
    if (status == ERROR_OK) both = pixels(sources, 2u * word);
    if (kTexels) {
      write_texels(area, b - area.first_block, 2u * word, both, status == ERROR_OK);
      continue;
    }
    const uvec3 pairs = uvec3(both[0]) | uvec3(both[1]) << 16;
    arguments.pixels.word[first_word + k] = pairs.x;
    arguments.pixels.word[first_word + k + (1u << sources.words_log2)] = pairs.y;
    arguments.pixels.word[first_word + k + (2u << sources.words_log2)] = pairs.z;
  }
  if (lane == 0u) arguments.pixel_statuses.word[b] = status;
}
