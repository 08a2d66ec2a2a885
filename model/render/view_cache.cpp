#include "render/view_cache.hpp"

#include <algorithm>
#include <mutex>
#include <tuple>

namespace hmlfc {

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
  if (!view) view = std::make_unique<CachedView>(place, shape_);
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
