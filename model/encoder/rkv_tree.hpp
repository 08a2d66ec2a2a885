// The representative key views of all levels above the views (paper, section "RLFC").
#pragma once

#include <vector>

#include "encoder/encode_part.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// Images of the levels above 0: images[l - 1][row * cols + col] of level l. They begin as the
/// filtered originals; the encoder replaces each level by its reconstruction as it goes down.
struct RkvTree {
  std::vector<std::vector<ImagePlanes>> levels;

  const ImagePlanes& at(const Geometry& geometry, int level, ImagePos pos) const {
    return levels[static_cast<size_t>(level) - 1]
                 [size_t{pos.row} * geometry.level(level).cols + pos.col];
  }
  ImagePlanes& at(const Geometry& geometry, int level, ImagePos pos) {
    return levels[static_cast<size_t>(level) - 1]
                 [size_t{pos.row} * geometry.level(level).cols + pos.col];
  }
};

/// Reduces each cluster to its mean, sample by sample, halves rounded up, level by level: the
/// originals of `part`; the rest stays empty.
RkvTree build_rkv_tree(const ViewProvider& views, const Geometry& geometry, const EncodePart& part);

}  // namespace hmlfc
