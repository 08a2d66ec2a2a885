// --threads, for everything that a command does.
#pragma once

#include <optional>

#include <tbb/global_control.h>

namespace hmlfc::cli {

/// While it lives, the process works on `threads` threads, more than there are cores too; 0 leaves
/// the choice to the system.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0) {
      limit_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    }
  }

 private:
  std::optional<tbb::global_control> limit_;
};

}  // namespace hmlfc::cli
