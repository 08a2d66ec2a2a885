#include <hmlfc/gpu/renderer.hpp>

#include "decoder/open_stream.hpp"
#include "renderer_state.hpp"

namespace hmlfc::gpu {

Outcome<GpuRenderer> GpuRenderer::open(Device& device, const StreamView& stream,
                                       uint64_t cache_bytes) {
  return guard_device(
      [&] { return GpuRenderer(std::make_shared<State>(device.state(), stream, cache_bytes)); });
}

Outcome<GpuRenderer> GpuRenderer::open(Device& device, const Decoder& stream,
                                       uint64_t cache_bytes) {
  return open(device, DecoderAccess::stream(stream), cache_bytes);
}

Outcome<GpuFrame> GpuRenderer::render(const FrameRecord& record, int stop_level) {
  return guard_device([&] {
    GpuFrame frame;
    state_->ring.begin(record, stop_level, FrameOutput::kHost);
    state_->ring.finish(frame);
    return frame;
  });
}

Outcome<void> GpuRenderer::begin(const FrameRecord& record, int stop_level, FrameOutput output) {
  return guard_device([&] { state_->ring.begin(record, stop_level, output); });
}

unsigned GpuRenderer::most_under_way() { return FrameRing::kSlots; }

unsigned GpuRenderer::under_way() const { return state_->ring.under_way(); }

Outcome<bool> GpuRenderer::ready() {
  return guard_device([&] { return state_->ring.ready(); });
}

Outcome<void> GpuRenderer::finish(GpuFrame& frame) {
  return guard_device([&] { state_->ring.finish(frame); });
}

uint64_t GpuRenderer::picture_address() const { return state_->ring.picture_address(); }

void GpuRenderer::forget() { state_->pool.forget(); }

const std::vector<StageTime>& GpuRenderer::stage_times() const {
  return state_->ring.stage_times();
}

}  // namespace hmlfc::gpu
