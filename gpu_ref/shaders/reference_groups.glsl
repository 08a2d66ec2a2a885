// Reference groups of a level and their reference images (STR-4, EXT-3, MOT-7).

/// The rows or the columns of a level's images, which are in `groups` reference groups of `size`.
struct ImageLine {
  uint count, size, groups;
  uint inverse, group_inverse;  // for divided()
};

ImageLine image_rows(LevelShape level) {
  return ImageLine(level.rows, level.ref_rows, level.group_rows, level.row_inverse,
                   level.group_row_inverse);
}
ImageLine image_cols(LevelShape level) {
  return ImageLine(level.cols, level.ref_cols, level.group_cols, level.col_inverse,
                   level.group_col_inverse);
}

/// The reference group of place `at` in a line.
uint group_in_line(ImageLine line, uint at) {
  return has_feature(FEATURE_BALANCED_GROUPS)
             ? divided((at + 1u) * line.groups - 1u, line.count, line.inverse)
             : divided(at, line.size, line.inverse);
}

/// The first place of reference group `group` in a line; `groups` gives `count`.
uint group_begin(ImageLine line, uint group) {
  return has_feature(FEATURE_BALANCED_GROUPS)
             ? divided(group * line.count, line.groups, line.group_inverse)
             : min(group * line.size, line.count);
}

uint reference_in_line(ImageLine line, uint group) {
  const uint first = group_begin(line, group);
  return first + ((group_begin(line, group + 1u) - first - 1u) >> 1);
}

/// A reference group and its reference image, row and column of each.
struct ReferenceGroup {
  uvec2 group, image;
};

/// The reference group of image `at` (row, column).
ReferenceGroup reference_group_of(LevelShape level, uvec2 at) {
  const ImageLine rows = image_rows(level);
  const ImageLine cols = image_cols(level);
  const uvec2 group = uvec2(group_in_line(rows, at.x), group_in_line(cols, at.y));
  return ReferenceGroup(group,
                        uvec2(reference_in_line(rows, group.x), reference_in_line(cols, group.y)));
}

/// i' of MOT-7 in one coordinate: the reference group beside `group` on the side of place `at`, or
/// on the other side, or itself.
uint group_beside(uint group, uint groups, uint at, uint reference) {
  if (groups == 1u) return group;
  const bool up = at >= reference ? group + 1u < groups : group == 0u;
  return up ? group + 1u : group - 1u;
}

/// The reference group of K0 to K3 of image `at`, which is in reference group `own` (MOT-7): K1 lies
/// beside it along one axis, K2 along the other, K3 along both.
ReferenceGroup reference_group(LevelShape level, uvec2 at, ReferenceGroup own, uint k) {
  const ivec2 distance = abs(ivec2(at) - ivec2(own.image));
  const bool h_first = distance.y >= distance.x;
  ReferenceGroup found = own;
  if (k == 3u || k == (h_first ? 2u : 1u)) {
    const ImageLine rows = image_rows(level);
    found.group.x = group_beside(own.group.x, rows.groups, at.x, own.image.x);
    found.image.x = reference_in_line(rows, found.group.x);
  }
  if (k == 3u || k == (h_first ? 1u : 2u)) {
    const ImageLine cols = image_cols(level);
    found.group.y = group_beside(own.group.y, cols.groups, at.y, own.image.y);
    found.image.y = reference_in_line(cols, found.group.y);
  }
  return found;
}

/// First word, in the reference area, of a plane of the reference image of group `group`.
uint reference_base(LevelShape level, PlaneShape plane, uvec2 group) {
  const uint number = level.first_reference + group.x * level.group_cols + group.y;
  return number * arguments.shape.reference_words + plane.first_word;
}
