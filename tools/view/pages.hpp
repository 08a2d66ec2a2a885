// Whether pages are open, for --once.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>

namespace hmlfc::view {

/// Pages that have been sent, and those of which one connection stays open: only that it ends tells
/// of every browser, and of one that is killed, that a page is gone.
class Pages {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  static constexpr std::chrono::seconds kSilence{90};  ///< after which a sent page counts as closed
  static constexpr std::chrono::seconds kReload{2};    ///< in which a reloaded page comes back

  /// A page has been sent: it counts as open until it arrives, which may take long where the
  /// machine is busy, or for kSilence. A page that is loaded again is sent before it closes.
  void sent(Time now);

  /// A page has been shown; opened() follows, by it or by another page of its browser.
  void arrived(Time now);

  /// Pages are open as long as what it returns lives, which `this` must outlive.
  std::shared_ptr<const void> opened();

  /// Whether pages have been open, and none is since kReload.
  bool all_closed(Time now);

 private:
  std::mutex mutex_;
  size_t coming_ = 0;  // pages that were sent and have not arrived
  Time last_sent_{};
  size_t open_ = 0;  // what opened() returned and lives
  bool any_ = false;
  Time last_seen_{};  // when a page arrived or closed
};

}  // namespace hmlfc::view
