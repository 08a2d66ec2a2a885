#include "gpu/host_cost.hpp"

#include <time.h>

#include <algorithm>
#include <thread>

#include <fmt/format.h>

namespace hmlfc::gpu {
namespace {

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Calls `call`, which gives an Outcome, and adds its CPU time.
template <class Call>
auto timed(const Call& call, double& seconds) {
  const double begin = thread_seconds();
  auto outcome = call();
  seconds += thread_seconds() - begin;
  return outcome;
}

// The CPU time of `frames` frames.
Outcome<double> draw(GpuRenderer& renderer, std::span<const FrameRecord> records, uint64_t frames) {
  double seconds = 0;
  GpuFrame frame;
  for (uint64_t begun = 0, finished = 0; finished < frames;) {
    if (begun < frames && renderer.under_way() < GpuRenderer::most_under_way()) {
      const FrameRecord& record = records[begun++ % records.size()];
      const auto done =
          timed([&] { return renderer.begin(record, 0, FrameOutput::kDevice); }, seconds);
      if (!done) return tl::unexpected(done.error());
      continue;
    }
    const auto ready = renderer.ready();
    if (!ready) return tl::unexpected(ready.error());
    if (!*ready) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      continue;
    }
    const auto done = timed([&] { return renderer.finish(frame); }, seconds);
    if (!done) return tl::unexpected(done.error());
    ++finished;
  }
  return seconds;
}

SubmissionCounts difference(const SubmissionCounts& after, const SubmissionCounts& before) {
  return {after.made - before.made, after.recorded - before.recorded,
          after.barriers - before.barriers, after.submitted - before.submitted,
          after.waits - before.waits};
}

}  // namespace

Outcome<HostCost> measure_host(GpuRenderer& renderer, const Device& device,
                               std::span<const FrameRecord> records, uint64_t frames) {
  const auto first =
      draw(renderer, records, std::max<uint64_t>(records.size(), GpuRenderer::most_under_way()));
  if (!first) return tl::unexpected(first.error());
  const SubmissionCounts before = device.counts();
  const auto seconds = draw(renderer, records, frames);
  if (!seconds) return tl::unexpected(seconds.error());
  return HostCost{frames, *seconds, difference(device.counts(), before)};
}

std::string to_text(const HostCost& cost) {
  return fmt::format(
      "host: {} frames that stay on the device, {} under way\n"
      "  {:<10} {:10.1f} us of CPU a frame\n"
      "  {} submissions, {} recordings, {} waits\n",
      cost.frames, GpuRenderer::most_under_way(), "calls",
      1e6 * cost.cpu_seconds / static_cast<double>(std::max<uint64_t>(cost.frames, 1)),
      cost.counts.submitted, cost.counts.recorded, cost.counts.waits);
}

}  // namespace hmlfc::gpu
