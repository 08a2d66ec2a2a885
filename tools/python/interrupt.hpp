// Long work that Ctrl-C stops.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <optional>

#include "python/object.hpp"

namespace hmlfc::python {

/// Thrown by work that was told to stop.
struct Stopped {};

/// Returns what work(stop) returns, on a thread of its own without the GIL, or throws what it
/// throws. Where the handler of a signal raises meanwhile, as Ctrl-C does, `stop` becomes true: the
/// work should soon end or throw Stopped, and what was raised is thrown. Needs the GIL.
template <class Work>
auto interruptible(const Work& work) {
  std::atomic<bool> stop = false;
  struct Stopping {
    std::atomic<bool>& stop;
    ~Stopping() { stop = true; }
  };
  auto result = std::async(std::launch::async, [&] { return work(stop); });
  const Stopping stopping{stop};  // where the thread ends with Python
  std::optional<Raised> raised;
  for (;;) {
    {
      const Unlocked unlocked;
      const auto status = result.wait_for(std::chrono::milliseconds(50));
      if (status == std::future_status::ready) break;
    }
    if (!raised && PyErr_CheckSignals() != 0) {
      raised.emplace();
      stop = true;
    }
  }
  if (raised) throw *raised;
  return result.get();
}

}  // namespace hmlfc::python
