// The inverse colour transform (section 6).

/// The greatest sample of R, G and B.
int greatest_sample() { return (1 << arguments.shape.depth) - 1; }

/// R, G and B of Y, Co and Cg, each clamped to [0, greatest] (COL-2).
ivec3 inverse_colour(ivec3 ycocg, int greatest) {
  const int t = ycocg.x - (ycocg.z >> 1);
  const int g = ycocg.z + t;
  const int b = t - (ycocg.y >> 1);
  const int r = b + ycocg.y;
  return clamp(ivec3(r, g, b), ivec3(0), ivec3(greatest));
}
