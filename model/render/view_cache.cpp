#include "render/view_cache.hpp"

#include <algorithm>
#include <mutex>
#include <tuple>

#include "arithmetic/rounding.hpp"

namespace hmlfc {

ViewShape::ViewShape(const StreamHeader& header, bool with_luma)
    : width(header.width),
      height(header.height),
      depth(header.depth),
      block_log2(header.block_log2),
      chroma_shift(header.chroma_format == ChromaFormat::k420 ? 1 : 0),
      sample_bytes(header.depth > 8 ? 2 : 1),
      keeps_luma(with_luma) {
  const uint32_t side = header.block_size();
  blocks_x = ceil_div(width, side);
  blocks_y = ceil_div(height, side);
  chroma_width = (width + chroma_shift) >> chroma_shift;
  chroma_height = (height + chroma_shift) >> chroma_shift;
  chroma_blocks_x = ceil_div(chroma_width, side);
  chroma_blocks_y = ceil_div(chroma_height, side);
  pages = ceil_div(height, kPageRows);
}

ViewPage::ViewPage(const ViewShape& shape) : pixels(shape.row_bytes() * kPageRows) {
  if (shape.keeps_luma) plane(Plane::kY).resize(size_t{shape.width} * kPageRows);
  for (const Plane p : {Plane::kCo, Plane::kCg}) {
    plane(p).resize(size_t{shape.chroma_width} * shape.page_chroma_rows());
  }
}

size_t ViewPage::bytes(const ViewShape& shape) {
  const size_t luma = shape.keeps_luma ? size_t{shape.width} * kPageRows : 0;
  const size_t chroma = size_t{2} * shape.chroma_width * shape.page_chroma_rows();
  return shape.row_bytes() * kPageRows + sizeof(int16_t) * (luma + chroma);
}

CachedView::CachedView(ViewPos place, const ViewShape& shape, const uint8_t* missing_row)
    : needed(shape.blocks_x, shape.blocks_y),
      held(shape.blocks_x, shape.blocks_y),
      needed_chroma(shape.chroma_blocks_x, shape.chroma_blocks_y),
      held_chroma(shape.chroma_blocks_x, shape.chroma_blocks_y),
      page_frame(shape.pages),
      place_(place),
      shape_(shape),
      pages_(shape.pages),
      missing_row_(missing_row),
      rows_(size_t{shape.height} + 1, missing_row) {}

void CachedView::derive_chroma() {
  if (shape_.chroma_shift == 0) {
    needed_chroma = needed;
  } else {
    needed_chroma.set_halves(needed);
  }
}

ViewPage& CachedView::page(uint32_t page) {
  if (!pages_[page]) {
    pages_[page] = std::make_unique<ViewPage>(shape_);
    const uint32_t end = std::min((page + 1) * kPageRows, shape_.height);
    for (uint32_t y = page * kPageRows; y < end; ++y) {
      rows_[y] = pages_[page]->pixels.data() + (y - page * kPageRows) * shape_.row_bytes();
    }
  }
  return *pages_[page];
}

bool CachedView::has_pages() const {
  return std::ranges::any_of(pages_, [](const auto& page) { return page != nullptr; });
}

void CachedView::drop_page(uint32_t page) {
  pages_[page].reset();
  const uint32_t end = std::min((page + 1) * kPageRows, shape_.height);
  std::fill(rows_.data() + page * kPageRows, rows_.data() + end, missing_row_);
  const auto drop_rows = [page](BlockBits& bits, uint32_t page_rows, uint32_t rows) {
    bits.clear_rows(page * page_rows, std::min((page + 1) * page_rows, rows));
  };
  drop_rows(held, shape_.page_block_rows(), shape_.blocks_y);
  drop_rows(held_chroma, shape_.page_chroma_block_rows(), shape_.chroma_blocks_y);
}

bool CachedView::needs_page(uint32_t page) const {
  const uint32_t first = page * shape_.page_block_rows();
  const uint32_t last = std::min(first + shape_.page_block_rows(), shape_.blocks_y);
  return needed.any_in_rows(first, last);
}

bool CachedView::misses_in_page(uint32_t page) const {
  const uint32_t rows = shape_.page_block_rows();
  const uint32_t chroma_rows = shape_.page_chroma_block_rows();
  return needed.any_without(held, page * rows, std::min((page + 1) * rows, shape_.blocks_y)) ||
         needed_chroma.any_without(held_chroma, page * chroma_rows,
                                   std::min((page + 1) * chroma_rows, shape_.chroma_blocks_y));
}

void ViewCache::begin_frame() { ++frame_; }

CachedView& ViewCache::use(ViewPos place, int stop_level) {
  const uint64_t key = key_of(place, stop_level);
  {
    const std::shared_lock lock(mutex_);
    const auto found = views_.find(key);
    if (found != views_.end() && found->second->frame == frame_) return *found->second;
  }
  const std::unique_lock lock(mutex_);
  auto& view = views_[key];
  if (!view) view = std::make_unique<CachedView>(place, shape_, missing_row_.data());
  if (view->frame != frame_) {
    view->needed.clear();
    view->frame = frame_;
  }
  return *view;
}

const CachedView* ViewCache::find(ViewPos place, int stop_level) const {
  const auto found = views_.find(key_of(place, stop_level));
  return found == views_.end() ? nullptr : found->second.get();
}

std::vector<CachedView*> ViewCache::used() {
  std::vector<std::pair<uint64_t, CachedView*>> found;
  for (const auto& [key, view] : views_) {
    if (view->frame == frame_) found.emplace_back(key, view.get());
  }
  std::sort(found.begin(), found.end());
  std::vector<CachedView*> views;
  for (const auto& [key, view] : found) views.push_back(view);
  return views;
}

void ViewCache::make_room() {
  size_t missing = 0;
  for (CachedView* view : used()) {
    for (uint32_t page = 0; page < shape_.pages; ++page) {
      if (!view->needs_page(page)) continue;
      view->page_frame[page] = frame_;
      if (!view->has_page(page)) missing += ViewPage::bytes(shape_);
    }
  }
  drop_oldest(missing, false);
}

void ViewCache::end_frame() { drop_oldest(0, true); }

size_t ViewCache::bytes() const {
  size_t pages = 0;
  for (const auto& [key, view] : views_) {
    for (uint32_t page = 0; page < shape_.pages; ++page) {
      if (view->has_page(page)) ++pages;
    }
  }
  return pages * ViewPage::bytes(shape_);
}

void ViewCache::drop_oldest(size_t wanted_bytes, bool also_of_this_frame) {
  const size_t page_bytes = ViewPage::bytes(shape_);
  size_t held = bytes();
  if (held + wanted_bytes <= budget_) return;
  std::vector<PlacedPage> pages;
  for (const auto& [key, view] : views_) {
    for (uint32_t page = 0; page < shape_.pages; ++page) {
      if (!view->has_page(page)) continue;
      if (view->page_frame[page] == frame_ && !also_of_this_frame) continue;
      pages.push_back({view->page_frame[page], view.get(), page});
    }
  }
  const auto order = [](const PlacedPage& at) {
    const ViewPos place = at.view->place();
    return std::tuple(at.frame, place.row, place.col, at.page);
  };
  std::sort(pages.begin(), pages.end(),
            [&](const PlacedPage& a, const PlacedPage& b) { return order(a) < order(b); });
  for (const PlacedPage& at : pages) {
    if (held + wanted_bytes <= budget_) break;
    at.view->drop_page(at.page);
    held -= page_bytes;
  }
  std::erase_if(views_, [&](const auto& entry) {
    return entry.second->frame != frame_ && !entry.second->has_pages();
  });
}

}  // namespace hmlfc
