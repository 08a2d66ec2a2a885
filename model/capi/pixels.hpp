// Memory of the caller that receives pixels.
#pragma once

#include <cstdint>

#include <hmlfc/hmlfc.h>
#include <hmlfc/image.hpp>

#include "capi/outcome.hpp"

namespace hmlfc::capi {

/// *pixels with its stride filled in, if it takes `width` x `height` pixels of `depth` bits.
tl::expected<hmlfc_pixels, Refusal> read_pixels(const hmlfc_pixels* pixels, uint32_t width,
                                                uint32_t height, int depth);

/// Copies `image` to `pixels`, which read_pixels gave for its size.
void store(const RgbImage& image, const hmlfc_pixels& pixels);

}  // namespace hmlfc::capi
