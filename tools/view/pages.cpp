#include "view/pages.hpp"

namespace hmlfc::view {

void Pages::sent(Time now) {
  const std::lock_guard lock(mutex_);
  ++coming_;
  last_sent_ = now;
}

void Pages::arrived(Time now) {
  const std::lock_guard lock(mutex_);
  if (coming_ > 0) --coming_;
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
  if (now - last_sent_ > kSilence) coming_ = 0;
  return any_ && open_ == 0 && coming_ == 0 && now - last_seen_ >= kReload;
}

}  // namespace hmlfc::view
