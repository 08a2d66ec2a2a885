// The samples that a displaced block is predicted from (DEC-4, MOT-9).

/// I(x, y) of MOT-9, with ref of DEC-4, at samples (x, y) and (x + 1, y) of the plane.
ivec2 weighted_sums(Reference reference, PlaneShape plane, int x, int y) {
  const ivec2 last = ivec2(plane.width, plane.height) - 1;
  const ivec3 cols = clamp(ivec3(0, 1, 2) + (x + reference.ix), ivec3(0), ivec3(last.x));  // DEC-5
  const ivec2 rows = clamp(ivec2(0, 1) + (y + reference.iy), ivec2(0), ivec2(last.y));
  const uint first = reference.base + uint(rows.x) * plane.row_words;
  const ivec2 upper = ivec2(row_sample(first, cols.x), row_sample(first, cols.y));
  if ((reference.fx | reference.fy) == 0) return upper << 6;
  const uint next = reference.base + uint(rows.y) * plane.row_words;
  const ivec3 above = ivec3(upper, row_sample(first, cols.z));
  const ivec3 below =
      ivec3(row_sample(next, cols.x), row_sample(next, cols.y), row_sample(next, cols.z));
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
