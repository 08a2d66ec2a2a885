#include "view/pages.hpp"

namespace hmlfc::view {

void Pages::sent(Time now) {
  const std::lock_guard lock(mutex_);
  coming_.push_back(now);
  if (coming_.size() > kMost) coming_.pop_front();
}

void Pages::arrived(Time now) {
  const std::lock_guard lock(mutex_);
  if (!coming_.empty()) coming_.pop_front();
  any_ = true;
  last_seen_ = now;
}

std::shared_ptr<const void> Pages::opened() {
  {
    const std::lock_guard lock(mutex_);
    ++open_;
  }
  return {this, [this](const void*) {
            const std::lock_guard lock(mutex_);
            --open_;
            any_ = true;
            last_seen_ = Clock::now();
          }};
}

bool Pages::all_closed(Time now) {
  const std::lock_guard lock(mutex_);
  std::erase_if(coming_, [now](Time sent) { return now - sent > kSilence; });
  return any_ && open_ == 0 && coming_.empty() && now - last_seen_ >= kReload;
}

}  // namespace hmlfc::view
