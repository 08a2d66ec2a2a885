// Which pages are open, for --once.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>

namespace hmlfc::view {

/// Pages that have been sent or have said that they are open, and not that they close.
class Pages {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::chrono::seconds kSilence{90};  ///< after which a page counts as closed
  static constexpr std::chrono::seconds kReload{2};    ///< in which a reloaded page comes back
  static constexpr size_t kMost = 256;                 ///< pages that are told apart

  /// A page has been sent: it counts as open until it says so, which may take long where the
  /// machine is busy, or for kSilence. A page that is loaded again is sent before it closes.
  void sent(Time now);

  /// Page `id` is open, unless it has closed: a browser's requests may change their order.
  void opened(uint32_t id, Time now);

  /// Page `id` closes, or is loaded again; it never comes back under that number.
  void closed(uint32_t id, Time now);

  /// Whether pages have been open, and none is since kReload.
  bool all_closed(Time now);

 private:
  std::mutex mutex_;
  std::deque<Time> coming_;         // when pages were sent that have not said that they are open
  std::map<uint32_t, Time> heard_;  // of each open page, when last
  std::deque<uint32_t> gone_;       // the last kMost that closed
  bool any_ = false;
  Time last_closed_{};
};

}  // namespace hmlfc::view
