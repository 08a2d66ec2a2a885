// The stages of a frame on the CPU: plan which blocks it needs, decode the missing ones page by
// page, sample. Plan and sample use all threads of the caller's run_on_threads().
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/image.hpp>

#include "decoder/fast/part_loader.hpp"
#include "decoder/key_images.hpp"
#include "render/displaced_cells.hpp"
#include "render/view_cache.hpp"

namespace hmlfc {

/// Sets `needed` of every view of the cache that the frame uses (NED-1); `cache` has begun a frame,
/// whose cells have the displacements `displaced`.
/// Returns the samples that the frame reads, three a pixel (FrameCounts::samples_interpolated).
uint64_t plan_frame(const FrameRecord& record, int stop_level, const StreamHeader& header,
                    const CellDisplacements& displaced, ViewCache& cache);

/// Appends the missing blocks of page `page` of `view`, of stop level `stop_level`, plane by plane.
void add_missing_parts(const StreamView& stream, const ViewShape& shape, int stop_level,
                       const CachedView& view, uint32_t page, std::vector<ImagePart>& parts);

/// Decodes the missing blocks of page `page` of `view`, whose needed blocks are set, and converts
/// them to pixels. Where `coarser` is not null it is the view's parent, of stop level + 1, with
/// samples of Y: blocks that it holds are decoded from there. Several threads may load different
/// pages of a view. Errors: a block does not decode; the page then holds no more blocks than
/// before. With `requests` not null, planes of key images that are needed and not decoded yet are
/// added to it instead of being decoded; if there are any, the page holds no more blocks either.
Result<void> load_page(const Decoder& decoder, const ViewShape& shape, int stop_level,
                       const CachedView* coarser, CachedView& view, uint32_t page,
                       KeyRequests* requests);

/// Fills `image` with the frame (sections 3, 4 and 9 of docs/rendering.md); `cache` holds every
/// block that the frame needs.
void sample_frame(const FrameRecord& record, int stop_level, const StreamHeader& header,
                  const CellDisplacements& displaced, ViewCache& cache, RgbImage& image);

}  // namespace hmlfc
