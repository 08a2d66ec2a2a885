// The arithmetic of samples (TIL-10, STP-2, STP-3, DEC-3).

/// The step of a step code in [0, MAX_STEP_CODE] (STP-2).
int step_of_code(uint code) {
  if (code == 0u) return 1;
  return (code & 1u) != 0u ? 1 << ((code + 1u) >> 1) : 3 << ((code - 2u) >> 1);
}

ivec4 first_samples(uvec4 pairs) { return bitfieldExtract(ivec4(pairs), 0, 16); }
ivec4 second_samples(uvec4 pairs) { return ivec4(pairs) >> 16; }
uvec4 sample_pairs(ivec4 first, ivec4 second) {
  return uvec4(bitfieldInsert(first, second, 16, 16));
}

/// Pairs of samples of a plane, clamped to what it allows.
uvec4 clamped_pairs(ivec4 first, ivec4 second, PlaneShape plane) {
  return sample_pairs(clamp(first, ivec4(plane.lo), ivec4(plane.hi)),
                      clamp(second, ivec4(plane.lo), ivec4(plane.hi)));
}

/// Returns the residuals at positions `first` to first + 7 of a block, as pairs of samples (TIL-9, TIL-10,
/// STP-3); values after the last sample of the block are unspecified. Reads each digit group once.
uvec4 residual_pairs(KeptEntry entry, PlaneShape plane, uint first) {
  const Levels levels = levels_of_code(level_code_of(entry));
  const Grouping grouping = grouping_of(levels);
  const uint word = values_word_of(entry);
  const uint bit = values_bit_of(entry);
  const uint count = 1u << (2u * arguments.shape.block_log2);
  const int offset = bias_of(entry) - int(levels.count >> 1);
  const int step = step_of_code(step_code_of(entry));
  uint number = group_of_value(grouping, first);
  uint k = first - number * grouping.values;
  bool wanted = true;  // the group of the next value
  DigitGroup group;
  uvec4 pairs = uvec4(0u);
  int even = 0;
  [[dont_unroll]] for (uint i = 0u; i < SAMPLES_OF_LANE; ++i) {
    if (wanted) group = read_group(word, bit, levels, grouping, count, number);
    const int centred = int(value_of_group(group, levels, grouping, k)) + offset;
    const int unstepped = clamp(centred, -plane.bound, plane.bound);
    const int residual = clamp(step * unstepped, -plane.bound, plane.bound);
    if ((i & 1u) != 0u) pairs = uvec4(pairs.yzw, sample_pair(ivec2(even, residual)));
    even = residual;
    ++k;
    wanted = k == grouping.values;
    if (wanted) {
      k = 0u;
      ++number;
    }
  }
  return pairs;
}

/// A(x, y) of DEC-3 with motion; `parents` are P(x, y), 0 at keyed levels (EXT-5).
uvec4 motion_prediction(uvec4 parents, bool negative, uvec4 references, PlaneShape plane) {
  const ivec4 even = first_samples(references);
  const ivec4 odd = second_samples(references);
  return clamped_pairs(first_samples(parents) + (negative ? -even : even),
                       second_samples(parents) + (negative ? -odd : odd), plane);
}

/// The samples of DEC-3 from A(x, y) and their residuals.
uvec4 add_residuals(uvec4 predictions, uvec4 residuals, PlaneShape plane) {
  return clamped_pairs(first_samples(predictions) + first_samples(residuals),
                       second_samples(predictions) + second_samples(residuals), plane);
}
