// Loads what a decoder needs of a partial source, in few rounds, before it is read.
#pragma once

#include <span>
#include <vector>

#include "decoder/fast/sparse_plane.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// Blocks of one plane of one image.
struct ImagePart {
  int level = 0;
  ImagePos image;
  Plane plane = Plane::kY;
  BlockRect rect;
};

/// Appends `part` and the same blocks of the ancestors that decoding it reads (DEC-1).
void add_with_ancestors(const Geometry& geometry, ImagePart part, std::vector<ImagePart>& parts);

/// Loads what decoding `parts` reads, without their ancestors: key images, tiles, motion tiles, and
/// those of reference images. Nothing to do where the source is not partial. The four dependent
/// reads of a walk (IDX-7) take a round each, for all parts together; what they lead to, motion
/// and reference blocks, takes the next rounds. Bytes that cannot be loaded have their error where
/// they are decoded. Without `keys` no key images.
void load_parts(const FastSources& sources, std::span<const ImagePart> parts, bool keys = true);

/// load_parts of all images of level `lowest` and above.
void load_images(const FastSources& sources, int lowest, bool keys = true);

}  // namespace hmlfc
