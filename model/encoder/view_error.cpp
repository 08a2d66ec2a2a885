#include "encoder/view_error.hpp"

#include "decoder/colour_row.hpp"

namespace hmlfc {

ErrorSums view_error(const LightField& original, ImagePos at, const ImagePlanes& planes,
                     ChromaFormat chroma) {
  const LightFieldShape& shape = original.shape();
  const Rect all{0, 0, shape.width, shape.height};
  const RgbImage decoded = rgb_picture(planes, all, chroma == ChromaFormat::k420, shape.depth);
  return measure(original.view(at.row, at.col), decoded);
}

}  // namespace hmlfc
