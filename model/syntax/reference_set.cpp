#include "syntax/reference_set.hpp"

namespace hmlfc {
namespace {

// i' of MOT-7: the group next to `group` of `groups` on the side of place `at`, the reference image
// of the group being at `reference`.
uint32_t next_group(uint32_t group, uint32_t groups, uint32_t at, uint32_t reference) {
  if (groups == 1) return group;
  const bool up = at >= reference ? group + 1 < groups : group == 0;
  return up ? group + 1 : group - 1;
}

uint32_t distance(uint32_t a, uint32_t b) { return a > b ? a - b : b - a; }

}  // namespace

ReferenceImages reference_images(const Geometry& geometry, int l, ImagePos at) {
  const LevelShape& level = geometry.level(l);
  const ImagePos group = geometry.group_of(l, at);
  const ImagePos own = geometry.reference_of_group(l, group);
  const uint32_t row = next_group(group.row, level.group_rows(), at.row, own.row);
  const uint32_t col = next_group(group.col, level.group_cols(), at.col, own.col);
  const ImagePos beside = geometry.reference_of_group(l, {group.row, col});
  const ImagePos above = geometry.reference_of_group(l, {row, group.col});
  const bool beside_first = distance(at.col, own.col) >= distance(at.row, own.row);
  return {own, beside_first ? beside : above, beside_first ? above : beside,
          geometry.reference_of_group(l, {row, col})};
}

}  // namespace hmlfc
