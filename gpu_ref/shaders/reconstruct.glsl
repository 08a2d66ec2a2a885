// The arithmetic of one sample (TIL-10, STP-2, STP-3, DEC-3).

/// The step of a step code in [0, MAX_STEP_CODE] (STP-2).
int step_of_code(uint code) {
  if (code == 0u) return 1;
  return (code & 1u) != 0u ? 1 << ((code + 1u) >> 1) : 3 << ((code - 2u) >> 1);
}

/// The residual at position i of a block (TIL-9, TIL-10, STP-3).
int residual_value(BlockEntry entry, PlaneShape plane, uint i) {
  const Levels levels = levels_of_code(entry.level_code);
  const uint samples = 1u << (2u * arguments.shape.block_log2);
  const uint value = bise_value(entry.values_word, entry.values_bit, levels, samples, i);
  const int centred = int(value) - int(levels.count >> 1) + entry.bias;
  const int unstepped = clamp(centred, -plane.bound, plane.bound);
  return clamp(step_of_code(entry.step_code) * unstepped, -plane.bound, plane.bound);
}

/// A(x, y) of DEC-3 with motion; `parent` is P(x, y), 0 at keyed levels (EXT-5).
int motion_prediction(int parent, bool negative, int reference, PlaneShape plane) {
  return clamp(negative ? parent - reference : parent + reference, plane.lo, plane.hi);
}

/// The sample of DEC-3 from A(x, y) and its residual.
int add_residual(int prediction, int residual, PlaneShape plane) {
  return clamp(prediction + residual, plane.lo, plane.hi);
}
