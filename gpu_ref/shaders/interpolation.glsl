// The samples that a displaced block is predicted from (DEC-4, MOT-9).

/// A reference and where its block lies in a plane.
struct Displaced {
  Reference reference;
  ivec2 origin;  // of the block's first sample
  bool inside;   // the plane has all columns and rows that samples are made of
  bool odd;      // origin.x is
  bool whole;    // fx and fy are 0
};

Displaced displaced_block(Reference reference, PlaneShape plane, ivec2 corner) {
  const ivec2 origin = corner + ivec2(reference.ix, reference.iy);
  const int size = 1 << arguments.shape.block_log2;
  // An invocation goes on below a block of fewer samples than it takes.
  const ivec2 reach = ivec2(size, max(size, int(SAMPLES_OF_LANE) >> arguments.shape.block_log2));
  const ivec2 room = ivec2(plane.width, plane.height) - reach;
  const bool inside = uint(origin.x) < uint(max(room.x, 0)) && uint(origin.y) < uint(max(room.y, 0));
  return Displaced(reference, origin, inside, (origin.x & 1) != 0,
                   (reference.fx | reference.fy) == 0);
}

/// ref of DEC-4 at x, x + 1 and x + 2 of row y of the plane.
ivec3 clamped_taps(uint base, PlaneShape plane, int x, int y) {
  const ivec2 last = ivec2(plane.width, plane.height) - 1;
  const uint first = base + uint(clamp(y, 0, last.y)) * plane.row_words;
  const ivec3 cols = clamp(ivec3(x, x + 1, x + 2), ivec3(0), ivec3(last.x));  // DEC-5
  return ivec3(row_sample(first, cols.x), row_sample(first, cols.y), row_sample(first, cols.z));
}

/// I of MOT-9 at column and row `place` of the block, and at the next column.
ivec2 weighted_sums(Displaced block, PlaneShape plane, ivec2 place) {
  const ivec2 at = block.origin + place;
  const uint word = block.reference.base + uint(at.y) * plane.row_words + (uint(at.x) >> 1);
  ivec3 above, below;
  if (block.inside) {
    above = word_samples(word, block.odd);
    if (block.whole) return above.xy << 6;
    below = word_samples(word + plane.row_words, block.odd);
  } else {
    above = ivec3(0);
    below = ivec3(0);
    [[dont_unroll]] for (int y = at.y; y <= at.y + 1; ++y) {
      above = below;
      below = clamped_taps(block.reference.base, plane, at.x, y);
    }
  }
  const ivec3 between = (8 - block.reference.fy) * above + block.reference.fy * below;
  return (8 - block.reference.fx) * between.xy + block.reference.fx * between.yz;
}

/// R of MOT-9 at positions `first` to first + 7 of the block whose first sample is `corner`, as pairs of
/// samples; for vectors of whole samples and one reference it is ref(x + dx, y + dy).
uvec4 reference_pairs(KeptEntry entry, PlaneShape plane, ivec2 corner, uint first) {
  const uint log2 = arguments.shape.block_log2;
  ivec4 even = ivec4(0);
  ivec4 odd = ivec4(0);
  const uint count = reference_count(entry);
  PackedReference reference = first_reference(entry);
  [[dont_unroll]] for (uint n = 0u; n < count; ++n) {
    const Displaced block = displaced_block(unpacked_reference(reference), plane, corner);
    [[dont_unroll]] for (uint i = first; i < first + SAMPLES_OF_LANE; i += 2u) {
      const ivec2 sums = weighted_sums(block, plane, ivec2(low_bits(i, log2), i >> log2));
      even = ivec4(even.yzw, even.x + sums.x);
      odd = ivec4(odd.yzw, odd.x + sums.y);
    }
    reference = second_reference(entry);
  }
  const int shift = int(5u + count);
  const int half_unit = 1 << (shift - 1);
  return sample_pairs((even + half_unit) >> shift, (odd + half_unit) >> shift);
}
