// Whole views by descriptors of the view unit.
#pragma once

#include <tl/expected.hpp>

#include <hmlfc/format.hpp>
#include <hmlfc/image.hpp>

#include "view/view_host.hpp"

namespace hmlfc::tb {

/// The pixels that a descriptor of an RGB format has written.
RgbImage read_pixels(const Descriptor& descriptor, const SparseBytes& memory, int depth);

/// The view, or the status of its first block with an error in the order of DEC-7. A finding of
/// `host` makes either meaningless. Forgets all places of the host.
tl::expected<RgbImage, unsigned> decode_view(ViewHost& host, ViewPos view);

}  // namespace hmlfc::tb
