#include "render/disparity_cache.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "decoder/open_stream.hpp"
#include "render/disparity_rows.hpp"

namespace hmlfc {

ViewDisparities::ViewDisparities(const StreamView& stream, ViewPos view)
    : looked_up(stream.geometry.plane(Plane::kY).blocks_x,
                stream.geometry.plane(Plane::kY).blocks_y),
      stream_(stream),
      view_(view),
      columns_(stream.geometry.plane(Plane::kY).blocks_x),
      rows_(stream.geometry.plane(Plane::kY).blocks_y),
      pages_(ceil_div(rows_, kPageBlockRows)) {}

const BlockDisparity* ViewDisparities::read(Page& page, uint32_t first) {
  const std::lock_guard lock(reading_);
  if (page.rows.empty()) {
    page.rows = disparity_rows(stream_, view_, first, std::min(first + kPageBlockRows, rows_));
    bytes_read += page.rows.size() * sizeof(BlockDisparity);
    page.blocks.store(page.rows.data(), std::memory_order_release);
  }
  return page.rows.data();
}

DisparityCache::DisparityCache(const Decoder& decoder, size_t budget)
    : decoder_(decoder), budget_(budget) {}

void DisparityCache::begin_frame() { ++frame_; }

ViewDisparities& DisparityCache::use(ViewPos view) {
  const uint64_t key = uint64_t{view.row} << 32 | view.col;
  {
    const std::shared_lock lock(mutex_);
    const auto found = views_.find(key);
    if (found != views_.end() && found->second->frame == frame_) return *found->second;
  }
  const std::unique_lock lock(mutex_);
  auto& used = views_[key];
  if (!used) used = std::make_unique<ViewDisparities>(DecoderAccess::stream(decoder_), view);
  if (used->frame != frame_) {
    used->looked_up.clear();
    used->frame = frame_;
  }
  return *used;
}

uint64_t DisparityCache::blocks_looked_up() const {
  uint64_t blocks = 0;
  for (const auto& [key, view] : views_) {
    if (view->frame == frame_) blocks += view->looked_up.count();
  }
  return blocks;
}

void DisparityCache::end_frame() {
  size_t bytes = 0;
  for (const auto& [key, view] : views_) bytes += view->bytes_read;
  for (auto view = views_.begin(); view != views_.end() && bytes > budget_;) {
    if (view->second->frame == frame_) {
      ++view;
      continue;
    }
    bytes -= view->second->bytes_read;
    view = views_.erase(view);
  }
}

}  // namespace hmlfc
