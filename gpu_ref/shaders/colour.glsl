// The inverse colour transform (section 6).

/// R, G and B of Y, Co and Cg, each clamped to [0, 2^depth - 1] (COL-2).
ivec3 inverse_colour(ivec3 ycocg, uint depth) {
  const int t = ycocg.x - (ycocg.z >> 1);
  const int g = ycocg.z + t;
  const int b = t - (ycocg.y >> 1);
  const int r = b + ycocg.y;
  return clamp(ivec3(r, g, b), ivec3(0), ivec3((1 << depth) - 1));
}
