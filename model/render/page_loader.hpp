// Decodes the blocks that a frame needs and the cache does not hold.
#pragma once

#include <hmlfc/decoder.hpp>

#include "render/view_cache.hpp"

namespace hmlfc {

/// Decodes the missing blocks of page `page` of `view`, whose needed blocks are set, and turns them
/// to pixels. Where `coarser` is not null it is the view's parent, of stop level + 1, with samples
/// of Y: blocks that it holds are decoded from there. Several threads may load different pages of a
/// view. Errors: one of the blocks does not decode; nothing of the page is then counted as held
/// that was not before.
Result<void> load_page(const Decoder& decoder, const ViewShape& shape, int stop_level,
                       const CachedView* coarser, CachedView& view, uint32_t page);

}  // namespace hmlfc
