// Reference groups of a level and their reference images (STR-4, EXT-3, MOT-7).

// A line is a row or column of a level's `count` images, in `groups` reference groups of `size`.

/// The reference group of place `at` in a line.
uint group_in_line(uint at, uint count, uint size, uint groups) {
  return has_feature(FEATURE_BALANCED_GROUPS) ? ((at + 1u) * groups - 1u) / count : at / size;
}

/// The first place of reference group `group` in a line; `groups` gives `count`.
uint group_begin(uint group, uint count, uint size, uint groups) {
  return has_feature(FEATURE_BALANCED_GROUPS) ? group * count / groups : min(group * size, count);
}

uint reference_in_line(uint group, uint count, uint size, uint groups) {
  const uint first = group_begin(group, count, size, groups);
  return first + ((group_begin(group + 1u, count, size, groups) - first - 1u) >> 1);
}

/// Row and column of the reference group of image `at` (row, column).
uvec2 reference_group_of(LevelShape level, uvec2 at) {
  return uvec2(group_in_line(at.x, level.rows, level.ref_rows, level.group_rows),
               group_in_line(at.y, level.cols, level.ref_cols, level.group_cols));
}

/// Row and column of the reference image of group `group` (row, column).
uvec2 reference_of_group(LevelShape level, uvec2 group) {
  return uvec2(reference_in_line(group.x, level.rows, level.ref_rows, level.group_rows),
               reference_in_line(group.y, level.cols, level.ref_cols, level.group_cols));
}

/// i' of MOT-7 in one coordinate: the reference group beside `group` on the side of place `at`, or
/// on the other side, or itself.
uint group_beside(uint group, uint groups, uint at, uint reference) {
  if (groups == 1u) return group;
  const bool up = at >= reference ? group + 1u < groups : group == 0u;
  return up ? group + 1u : group - 1u;
}

/// The reference groups of K0 to K3 of image `at`, which is in reference group `own` (MOT-7).
uvec2[4] reference_groups(LevelShape level, uvec2 at, uvec2 own) {
  const uvec2 k0 = reference_of_group(level, own);
  const uint row = group_beside(own.x, level.group_rows, at.x, k0.x);
  const uint col = group_beside(own.y, level.group_cols, at.y, k0.y);
  const uvec2 h = uvec2(own.x, col);
  const uvec2 v = uvec2(row, own.y);
  const ivec2 distance = abs(ivec2(at) - ivec2(k0));
  const bool h_first = distance.y >= distance.x;
  return uvec2[4](own, h_first ? h : v, h_first ? v : h, uvec2(row, col));
}

/// First word, in the reference area, of a plane of the reference image of group `group`.
uint reference_base(LevelShape level, PlaneShape plane, uvec2 group) {
  const uint number = level.first_reference + group.x * level.group_cols + group.y;
  return number * arguments.shape.reference_words + plane.first_word;
}
