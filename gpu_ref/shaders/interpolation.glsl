// The samples that a displaced block is predicted from (DEC-4, MOT-9).

/// I(x, y) of MOT-9 at sample (x, y) of the plane. A sample whose weight is 0 is not read.
int weighted_sum(Reference reference, PlaneShape plane, int x, int y) {
  const int x0 = x + reference.ix;
  const int y0 = y + reference.iy;
  const int fx = reference.fx;
  const int fy = reference.fy;
  int sum = (8 - fy) * (8 - fx) * ref(reference.base, plane, x0, y0);
  if (fx != 0) sum += (8 - fy) * fx * ref(reference.base, plane, x0 + 1, y0);
  if (fy != 0) sum += fy * (8 - fx) * ref(reference.base, plane, x0, y0 + 1);
  if (fx != 0 && fy != 0) sum += fy * fx * ref(reference.base, plane, x0 + 1, y0 + 1);
  return sum;
}

/// R(x, y) of MOT-9, which for vectors of whole samples and one reference is ref(x + dx, y + dy).
int reference_value(BlockEntry entry, PlaneShape plane, int x, int y) {
  const int first = weighted_sum(entry.references[0], plane, x, y);
  if (entry.count == 1u) return round_shift(first, 6u);
  return round_shift(first + weighted_sum(entry.references[1], plane, x, y), 7u);
}
