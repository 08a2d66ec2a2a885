// Decodes the blocks that a frame needs and the cache does not hold.
#pragma once

#include <hmlfc/decoder.hpp>

#include "render/view_cache.hpp"

namespace hmlfc {

/// Decodes the missing blocks of page `page` of `view`, whose needed blocks are set, and turns them
/// to pixels. Several threads may load different pages of a view. Errors: one of the blocks does
/// not decode; nothing of the page is then counted as held that was not before.
Result<void> load_page(const Decoder& decoder, const ViewShape& shape, int stop_level,
                       CachedView& view, uint32_t page);

}  // namespace hmlfc
