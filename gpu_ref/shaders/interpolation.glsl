// The samples that a displaced block is predicted from (DEC-4, MOT-9).

/// ref of DEC-4 at x, x + 1 and x + 2 of row y of the plane at `base`.
ivec3 reference_taps(uint base, PlaneShape plane, int x, int y) {
  const uint first = base + uint(clamp(y, 0, int(plane.height) - 1)) * plane.row_words;
  const int last = int(plane.width) - 1;
  if (uint(x) < uint(max(last - 1, 0))) return row_samples(first, x);
  const ivec3 cols = clamp(ivec3(x, x + 1, x + 2), ivec3(0), ivec3(last));  // DEC-5
  return ivec3(row_sample(first, cols.x), row_sample(first, cols.y), row_sample(first, cols.z));
}

/// I(x, y) of MOT-9, with ref of DEC-4, at samples (x, y) and (x + 1, y) of the plane.
ivec2 weighted_sums(Reference reference, PlaneShape plane, int x, int y) {
  const ivec2 at = ivec2(x + reference.ix, y + reference.iy);
  const ivec3 above = reference_taps(reference.base, plane, at.x, at.y);
  if ((reference.fx | reference.fy) == 0) return above.xy << 6;
  const ivec3 below = reference_taps(reference.base, plane, at.x, at.y + 1);
  const ivec3 between = (above << 3) + reference.fy * (below - above);
  return (between.xy << 3) + reference.fx * (between.yz - between.xy);
}

/// R(x, y) of MOT-9 at the same samples, which for vectors of whole samples and one reference is
/// ref(x + dx, y + dy).
ivec2 reference_pair(BlockEntry entry, PlaneShape plane, int x, int y) {
  ivec2 sum = ivec2(0);
  Reference reference = entry.references[0];
  [[dont_unroll]] for (uint i = 0u; i < entry.count; ++i) {
    sum += weighted_sums(reference, plane, x, y);
    reference = entry.references[1];
  }
  return entry.count == 1u ? (sum + 32) >> 6 : (sum + 64) >> 7;
}
