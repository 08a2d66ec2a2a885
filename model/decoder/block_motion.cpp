#include "decoder/block_motion.hpp"

namespace hmlfc {

MotionResolver::MotionResolver(const StreamView& stream, int level, ImagePos image, Plane plane)
    : image_(image),
      images_(reference_images(stream.geometry, level, image)),
      rules_(vector_rules(stream.header)),
      vector_precision_(stream.header.vector_precision),
      halved_(plane != Plane::kY &&
              stream.geometry.motion_planes()[stream.geometry.motion_plane_of(plane)].halves) {}

BlockMotion MotionResolver::resolve(const PaletteEntry& entry, int32_t disparity) const {
  BlockMotion motion;
  if (!entry.has_motion()) return motion;
  const ReferenceSet set = references_of_set(entry.reference_set);
  const int32_t d = entry.shares_disparity() ? disparity : entry.explicit_x;
  motion.count = set.count;
  motion.negative = entry.negative;
  for (unsigned i = 0; i < set.count; ++i) {
    const ImagePos reference = images_[set.reference[i]];
    const MotionVector vector = entry.choice == kChoiceVector
                                    ? explicit_vector(entry.explicit_x, entry.explicit_y, rules_)
                                    : disparity_vector(d, row_offset(reference, image_),
                                                       col_offset(reference, image_), rules_);
    motion.references[i] = {reference, subpel_vector(vector, vector_precision_, halved_)};
  }
  return motion;
}

}  // namespace hmlfc
