// Adds up the times of stages.
#pragma once

#include <algorithm>
#include <vector>

#include <hmlfc/gpu/decoder.hpp>

namespace hmlfc::gpu {

/// Adds `more` to the times of the same stages in `times`, and appends new stages.
inline void add_times(const std::vector<StageTime>& more, std::vector<StageTime>& times) {
  for (const StageTime& time : more) {
    const auto found = std::ranges::find(times, time.stage, &StageTime::stage);
    if (found == times.end()) {
      times.push_back(time);
    } else {
      found->seconds += time.seconds;
    }
  }
}

}  // namespace hmlfc::gpu
