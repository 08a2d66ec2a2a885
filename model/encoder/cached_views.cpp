#include "encoder/cached_views.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace hmlfc {

CachedViews::CachedViews(const ViewProvider& views, const Rect& part, uint64_t max_bytes)
    : views_(views), part_(part), shape_(views.shape()) {
  shape_.width = part.width;
  shape_.height = part.height;
  view_bytes_ = uint64_t{shape_.width} * shape_.height * 3 * (shape_.depth > 8 ? 2 : 1);
  max_views_ = max_bytes / view_bytes_;
}

RgbImage CachedViews::view(ViewPos at) const {
  const uint64_t key = uint64_t{at.row} * shape_.cols + at.col;
  std::shared_ptr<const LightField> found;
  {
    const std::scoped_lock lock(mutex_);
    if (const auto kept = kept_.find(key); kept != kept_.end()) {
      kept->second.last_use = ++uses_;
      found = kept->second.view;
    }
  }
  if (found) return found->view(0, 0);
  found = fetch(at);
  RgbImage image = found->view(0, 0);
  if (max_views_ == 0) return image;
  const std::scoped_lock lock(mutex_);
  kept_[key] = {std::move(found), ++uses_};
  if (kept_.size() > max_views_) {
    const auto before = [](const auto& a, const auto& b) {
      return a.second.last_use < b.second.last_use;
    };
    kept_.erase(std::ranges::min_element(kept_, before));
  }
  return image;
}

std::shared_ptr<const LightField> CachedViews::fetch(ViewPos at) const {
  const RgbImage whole = views_.view(at);
  const auto view = std::make_shared<LightField>(
      LightFieldShape{1, 1, shape_.width, shape_.height, shape_.depth});
  for (uint32_t y = 0; y < shape_.height; ++y) {
    const size_t first = (size_t{part_.y + y} * whole.width + part_.x) * 3;
    view->write_row(0, 0, y, std::span(whole.samples).subspan(first, size_t{shape_.width} * 3));
  }
  return view;
}

}  // namespace hmlfc
