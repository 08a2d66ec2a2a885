// Measuring a reconstructed view against its original.
#pragma once

#include <hmlfc/encoder.hpp>
#include <hmlfc/light_field.hpp>

#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// The error of view `at` of `original` decoded to `planes`, measured in RGB as a decoder returns
/// it.
ErrorSums view_error(const LightField& original, ImagePos at, const ImagePlanes& planes,
                     ChromaFormat chroma);

}  // namespace hmlfc
