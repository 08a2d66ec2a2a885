// The fast renderer: plan, decode what is missing, sample.
#include <hmlfc/renderer.hpp>

#include <atomic>
#include <chrono>
#include <optional>
#include <vector>

#include "bits/parallel.hpp"
#include "decoder/missing_ranges.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"
#include "render/disparity_cache.hpp"
#include "render/displaced_cells.hpp"
#include "render/frame_stages.hpp"
#include "render/shown_image.hpp"

namespace hmlfc {
namespace {

// Seconds since the last call or since construction.
class Laps {
 public:
  double next() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> lap = now - begin_;
    begin_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// The part of RenderOptions::cache_bytes that disparity maps take: 4 bytes a block, where pixels
// take 16 to 512.
constexpr size_t kMapShare = 16;

class CpuRenderer final : public FrameRenderer {
 public:
  CpuRenderer(const Decoder& decoder, const RenderOptions& options)
      : decoder_(decoder),
        progressive_(options.progressive),
        cache_(decoder.header(), options.cache_bytes, options.progressive),
        disparities_(decoder, options.cache_bytes / kMapShare),
        threads_(options.threads) {}

  Result<void> render(const FrameRecord& record, int stop_level, Frame& frame) override {
    if (!fits(record, decoder_.header(), stop_level)) {
      return fail(ErrorCode::kBadRequest, Section::kHeader, 0);
    }
    return guard_request(DecoderAccess::stream(decoder_).source, [&] {
      Result<void> rendered;
      run_on_threads(threads_, [&] { rendered = render_here(record, stop_level, frame); });
      return rendered;
    });
  }

 private:
  Result<void> render_here(const FrameRecord& record, int stop_level, Frame& frame) {
    Laps laps;
    const StreamHeader& header = decoder_.header();
    cache_.begin_frame();
    find_displaced(record, stop_level);
    frame.counts = {};
    frame.counts.disparities_looked_up = displaced_.blocks_looked_up;
    frame.counts.samples_interpolated = plan_frame(record, stop_level, header, displaced_, cache_);
    count_blocks(frame.counts);
    frame.seconds.plan = laps.next();
    if (auto ok = load(stop_level); !ok) {
      cache_.end_frame();
      return ok;
    }
    frame.seconds.decode = laps.next();
    sample_frame(record, stop_level, header, displaced_, cache_, frame.image);
    cache_.end_frame();
    frame.seconds.sample = laps.next();
    return {};
  }

  void find_displaced(const FrameRecord& record, int stop_level) {
    const StreamView& stream = DecoderAccess::stream(decoder_);
    const auto find = [&](const StreamView& view) {
      disparities_.begin_frame(view);
      find_displacements(record, stop_level, view.header.block_log2, disparities_, displaced_);
    };
    if (stream.source == nullptr) {
      find(stream);
    } else {
      load_by_trials(stream, [&](const StreamView& view, const MissingRanges&) { find(view); });
    }
    disparities_.end_frame();
  }

  // Counts the needed blocks and how many of them are held.
  void count_blocks(FrameCounts& counts) {
    for (CachedView* view : cache_.used()) {
      view->derive_chroma();
      counts.blocks_needed += view->needed.count() + 2 * view->needed_chroma.count();
      counts.blocks_decoded += view->needed.count_without(view->held) +
                               2 * view->needed_chroma.count_without(view->held_chroma);
    }
    counts.blocks_reused = counts.blocks_needed - counts.blocks_decoded;
  }

  struct Missing {
    CachedView* view;
    uint32_t page;
  };

  // The cached parent of a view of level `stop_level`; null without one, or where its pages keep no
  // samples to decode from.
  const CachedView* coarser(const CachedView& view, int stop_level) const {
    if (!progressive_ || stop_level == decoder_.header().tree_height) return nullptr;
    const int level = stop_level + 1;
    return cache_.find(first_view_of(decoder_.header(), view.place(), level), level);
  }

  std::vector<Missing> missing_pages() {
    std::vector<Missing> missing;
    for (CachedView* view : cache_.used()) {
      for (uint32_t page = 0; page < cache_.shape().pages; ++page) {
        if (view->misses_in_page(page)) missing.push_back({view, page});
      }
    }
    return missing;
  }

  // Loads what the frame needs. Pages whose key images are all decoded come first; then the key
  // images that the others need are decoded, all at once, and those pages after them. An error of
  // a key image shows where a page reads it, as all errors of pages do in first_error().
  Result<void> load(int stop_level) {
    cache_.make_room();
    std::vector<Missing> missing = missing_pages();
    load_bytes(missing, stop_level);
    // One thread creates the pages: the pages of a view share its table of rows.
    for (const Missing& at : missing) at.view->page(at.page);
    std::vector<KeyRequests> requests(missing.size());
    load_pages(missing, stop_level, requests.data());
    std::erase_if(missing, [](const Missing& at) { return !at.view->misses_in_page(at.page); });
    if (missing.empty()) return {};
    DecoderAccess::decode_keys(decoder_, requests);
    if (load_pages(missing, stop_level, nullptr)) return {};
    return tl::unexpected(first_error(stop_level));
  }

  // From a partial source, in few rounds for all pages.
  void load_bytes(const std::vector<Missing>& missing, int stop_level) const {
    const StreamView& stream = DecoderAccess::stream(decoder_);
    if (stream.source == nullptr) return;
    std::vector<ImagePart> parts;
    for (const Missing& at : missing) {
      add_missing_parts(stream, cache_.shape(), stop_level, *at.view, at.page, parts);
    }
    DecoderAccess::load(decoder_, parts);
  }

  // Loads pages; where `requests` is not null page i has requests[i]. Returns whether none failed.
  bool load_pages(const std::vector<Missing>& pages, int stop_level, KeyRequests* requests) {
    std::atomic<bool> loaded = true;
    parallel_for(pages.size(), [&](size_t i) {
      const Missing& at = pages[i];
      const auto ok = guard_memory([&] {
        return load_page(decoder_, cache_.shape(), stop_level, coarser(*at.view, stop_level),
                         *at.view, at.page, requests == nullptr ? nullptr : requests + i);
      });
      if (!ok) loaded = false;
    });
    return loaded;
  }

  // The error of the first needed block that does not decode (NED-2).
  Error first_error(int stop_level) {
    for (CachedView* view : cache_.used()) {
      for (const Plane plane : kPlanes) {
        const bool luma = plane == Plane::kY;
        const BlockBits& needed = luma ? view->needed : view->needed_chroma;
        const BlockBits& held = luma ? view->held : view->held_chroma;
        const auto error = first_error_in(view->place(), plane, needed, held, stop_level);
        if (error) return *error;
      }
    }
    return {ErrorCode::kOutOfMemory, Section::kHeader, 0};
  }

  std::optional<Error> first_error_in(ViewPos view, Plane plane, const BlockBits& needed,
                                      const BlockBits& held, int stop_level) const {
    std::optional<Error> error;
    const uint32_t rows =
        plane == Plane::kY ? cache_.shape().blocks_y : cache_.shape().chroma_blocks_y;
    for (uint32_t by = 0; by < rows && !error; ++by) {
      needed.for_each_run_without(held, by, [&](uint32_t begin, uint32_t end) {
        for (uint32_t bx = begin; bx < end && !error; ++bx) {
          const auto block =
              decoder_.decode_block({view, plane, bx, by}, {.stop_level = stop_level});
          if (!block) error = block.error();
        }
      });
    }
    return error;
  }

  const Decoder& decoder_;
  bool progressive_;
  ViewCache cache_;
  DisparityCache disparities_;
  CellDisplacements displaced_;  // of the frame
  int threads_;
};

}  // namespace

std::unique_ptr<FrameRenderer> make_cpu_renderer(const Decoder& decoder,
                                                 const RenderOptions& options) {
  return std::make_unique<CpuRenderer>(decoder, options);
}

}  // namespace hmlfc
