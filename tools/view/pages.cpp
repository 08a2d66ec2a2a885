#include "view/pages.hpp"

#include <algorithm>

namespace hmlfc::view {

void Pages::opened(uint32_t id, Time now) {
  const std::lock_guard lock(mutex_);
  if (heard_.size() >= kMost && !heard_.contains(id)) return;
  if (std::ranges::find(gone_, id) != gone_.end()) return;
  heard_[id] = now;
  any_ = true;
}

void Pages::closed(uint32_t id, Time now) {
  const std::lock_guard lock(mutex_);
  heard_.erase(id);
  any_ = true;
  last_closed_ = now;
  gone_.push_back(id);
  if (gone_.size() > kMost) gone_.pop_front();
}

bool Pages::all_closed(Time now) {
  const std::lock_guard lock(mutex_);
  const auto silent = [now](const auto& page) { return now - page.second > kSilence; };
  if (std::erase_if(heard_, silent) > 0) last_closed_ = now;
  return any_ && heard_.empty() && now - last_closed_ >= kReload;
}

}  // namespace hmlfc::view
