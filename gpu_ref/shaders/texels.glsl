// Pixels as textures have them: R, G, B and A side by side, in rows. 8 bits each at depth 8, else 16.

/// colour.comp and render.comp write texels instead of lanes.
layout(constant_id = 6) const bool kTexels = false;

/// The words of a texel, at depth 8 the first alone. A is the greatest sample; of a pixel that did not
/// decode all four are 0.
uvec2 words_of_texel(ivec3 rgb, bool decoded) {
  const uint depth = arguments.shape.depth;
  const uvec4 rgba = decoded ? uvec4(uvec3(rgb), (1u << depth) - 1u) : uvec4(0u);
  return depth == 8u ? uvec2(rgba.r | rgba.g << 8 | rgba.b << 16 | rgba.a << 24, 0u)
                     : uvec2(rgba.r | rgba.g << 16, rgba.b | rgba.a << 16);
}

/// The texel of a pixel of `area` at `at` in its view, if it is inside.
void write_texel(ColourArea area, uvec2 at, ivec3 rgb, bool decoded) {
  const uint log2 = arguments.shape.block_log2;
  const PlaneShape plane = arguments.shape.planes[0];
  if (at.x >= plane.width || at.y >= plane.height) return;
  const uvec2 corner = uvec2(area.bx, area.by) << log2;
  const uint width = min(area.columns << log2, plane.width - corner.x);
  const uint texel = area.first_texel + (at.y - corner.y) * width + at.x - corner.x;
  const uvec2 words = words_of_texel(rgb, decoded);
  if (arguments.shape.depth == 8u) {
    arguments.pixels.word[texel] = words.x;
  } else {
    arguments.pixels.word[2u * texel] = words.x;
    arguments.pixels.word[2u * texel + 1u] = words.y;
  }
}

/// The texels of positions i, which is even, and i + 1 of block `at` of `area`.
void write_texels(ColourArea area, uint at, uint i, ivec3[2] rgb, bool decoded) {
  const uvec2 block = uvec2(area.bx, area.by) + uvec2(at % area.columns, at / area.columns);
  const PlaneShape plane = arguments.shape.planes[0];
  if (block.x >= plane.blocks_x || block.y >= plane.blocks_y) return;
  const uvec2 place = (block << arguments.shape.block_log2) + place_in_block(i);
  write_texel(area, place, rgb[0], decoded);
  write_texel(area, place + uvec2(1u, 0u), rgb[1], decoded);
}
