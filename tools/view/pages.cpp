#include "view/pages.hpp"

#include <algorithm>

namespace hmlfc::view {

void Pages::sent(Time now) {
  const std::lock_guard lock(mutex_);
  coming_.push_back(now);
  if (coming_.size() > kMost) coming_.pop_front();
}

void Pages::opened(uint32_t id, Time now) {
  const std::lock_guard lock(mutex_);
  if (std::ranges::find(gone_, id) != gone_.end()) return;
  if (!heard_.contains(id)) {
    if (heard_.size() >= kMost) return;
    if (!coming_.empty()) coming_.pop_front();
  }
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
  std::erase_if(coming_, [now](Time sent) { return now - sent > kSilence; });
  return any_ && heard_.empty() && coming_.empty() && now - last_closed_ >= kReload;
}

}  // namespace hmlfc::view
