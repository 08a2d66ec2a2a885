#include "gpu/host_cost.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "gpu/cpu_time.hpp"

namespace hmlfc::gpu {
namespace {

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

}  // namespace

Outcome<HostCost> measure_host(GpuRenderer& renderer, const Device& device,
                               std::span<const FrameRecord> records, uint64_t frames) {
  const auto first =
      draw(renderer, records, std::max<uint64_t>(records.size(), GpuRenderer::most_under_way()));
  if (!first) return tl::unexpected(first.error());
  const SubmissionCounts before = device.counts();
  const auto seconds = draw(renderer, records, frames);
  if (!seconds) return tl::unexpected(seconds.error());
  return HostCost{frames, *seconds, counted_since(before, device)};
}

std::string to_text(const HostCost& cost, const std::string& what) {
  return fmt::format(
      "host: {} frames {}, {} under way\n"
      "  {:<10} {:10.1f} us of CPU a frame\n"
      "  {} submissions, {} recordings, {} waits\n",
      cost.frames, what, GpuRenderer::most_under_way(), "calls",
      1e6 * cost.cpu_seconds / static_cast<double>(std::max<uint64_t>(cost.frames, 1)),
      cost.counts.submitted, cost.counts.recorded, cost.counts.waits);
}

}  // namespace hmlfc::gpu
