#include "render/key_images_of.hpp"

#include "syntax/geometry.hpp"

namespace hmlfc {
namespace {

void collect(const Geometry& geometry, bool two_references, int level, ImagePos image,
             std::set<KeyImage>& keys) {
  if (geometry.is_key(level, image)) {
    keys.insert({level, image.row, image.col});
    return;
  }
  if (!geometry.is_reference(level, image)) {
    ReferenceImages references = reference_images(geometry, level, image);
    if (!two_references) references.fill(references[0]);
    for (const ImagePos reference : references) {
      collect(geometry, two_references, level, reference, keys);
    }
  }
  if (level == geometry.top()) return;
  collect(geometry, two_references, level + 1, geometry.ancestor(image, level, level + 1), keys);
}

}  // namespace

std::set<KeyImage> key_images_of(const StreamHeader& header, ViewPos view, int stop_level) {
  const Geometry geometry(header);
  std::set<KeyImage> keys;
  const ImagePos image = geometry.ancestor({view.row, view.col}, 0, stop_level);
  collect(geometry, header.has(Feature::kTwoReferences), stop_level, image, keys);
  return keys;
}

}  // namespace hmlfc
