// What calls take of the calling thread, and of the device's submissions.
#pragma once

#include <time.h>

#include <hmlfc/gpu/device.hpp>

namespace hmlfc::gpu {

/// CPU time of the calling thread.
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Calls `call`, which gives an Outcome, and adds its CPU time.
template <class Call>
auto timed(const Call& call, double& seconds) {
  const double begin = thread_seconds();
  auto outcome = call();
  seconds += thread_seconds() - begin;
  return outcome;
}

/// What `device` counted after `before`.
inline SubmissionCounts counted_since(const SubmissionCounts& before, const Device& device) {
  const SubmissionCounts& now = device.counts();
  return {now.made - before.made, now.recorded - before.recorded, now.barriers - before.barriers,
          now.submitted - before.submitted, now.waits - before.waits};
}

}  // namespace hmlfc::gpu
