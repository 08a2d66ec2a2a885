// The search for an area among areas that follow each other. The kernel says what it searches: AREA, the
// type of an area, AREAS, their buffer, and FIRST, the member with the first number of an area.

/// The area of the first `count` that holds number `number`: the last that begins at it or before it.
AREA area_of(uint number, uint count) {
  uint low = 0u;
  uint high = count;
  while (high - low > 1u) {
    const uint middle = (low + high) >> 1;
    if (AREAS.area[middle].FIRST <= number) low = middle; else high = middle;
  }
  return AREAS.area[low];
}
