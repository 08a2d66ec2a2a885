#include <hmlfc/gpu/recording.hpp>

#include <utility>

#include "decode/texel_target.hpp"
#include "device/submission.hpp"
#include "render/shown_image.hpp"
#include "renderer_state.hpp"

namespace hmlfc::gpu {

struct FrameRecording::State {
  explicit State(std::shared_ptr<GpuRenderer::State> r)
      : renderer(std::move(r)),
        buffers(renderer->device),
        commands(renderer->device, &buffers.arguments()) {}

  std::shared_ptr<GpuRenderer::State> renderer;
  FrameBuffers buffers;
  Commands commands;
  bool refused = false;  // nothing was recorded: the frame does not fit
};

namespace {

void write_frame(FrameRecording::State& recording, VkCommandBuffer handle,
                 const FrameRecord& record, int stop_level, const TexelTarget& target) {
  GpuRenderer::State& renderer = *recording.renderer;
  recording.refused = !fits(record, renderer.header, stop_level);
  if (recording.refused) return;
  FrameForm form = renderer.form_of(record, stop_level);
  form.texel_bytes = renderer.sizes.texel_bytes;
  const KernelUse use = form.geometry ? KernelUse::kGeometryTexels : KernelUse::kFrameTexels;
  renderer.device.kernels->prepare(use, renderer.stream.chunked(), renderer.pool.chunked());
  FrameBuffers& buffers = recording.buffers;
  Commands& commands = recording.commands;
  commands.finished();
  buffers.prepare(renderer.device, form);
  buffers.arguments().record = record;
  buffers.arguments().forget = renderer.pool.take_forget();
  commands.begin(handle, {});
  renderer.write(commands, buffers, form);
  buffers.write_arguments();
  commands.barrier(kCompute, kTransfer | kHost);
  target.write(commands, buffers.drawn(), form.drawn_bytes());
  commands.read_by_host(buffers.results());
  commands.check();
}

// The state of `recording`, made for this renderer where it is not yet.
FrameRecording::State& state_for(const GpuRenderer& renderer, FrameRecording& recording) {
  usable(renderer.state()->device);
  auto& state = recording.state();
  if (state == nullptr || state->renderer != renderer.state()) {
    state.reset();
    state = std::make_unique<FrameRecording::State>(renderer.state());
  }
  return *state;
}

}  // namespace

FrameRecording::FrameRecording() = default;
FrameRecording::FrameRecording(FrameRecording&&) noexcept = default;
FrameRecording& FrameRecording::operator=(FrameRecording&&) noexcept = default;
FrameRecording::~FrameRecording() = default;

RecordedFrame FrameRecording::result() const {
  RecordedFrame frame;
  frame.status = ErrorCode::kBadRequest;
  if (state_ == nullptr || state_->refused) return frame;
  const auto counters = state_->buffers.counters();
  frame.status = state_->buffers.status();
  frame.had_room = counters[kCountMode] != kModeNoRoom;
  frame.blocks_needed = counters[kCountNeeded];
  frame.blocks_decoded = counters[kCountDecoded];
  frame.disparities_looked_up = counters[kCountLookedUp];
  return frame;
}

Outcome<void> record(GpuRenderer& renderer, VkCommandBuffer commands, const FrameRecord& record,
                     int stop_level, const BufferTarget& target, FrameRecording& recording) {
  return guard_device([&] {
    write_frame(state_for(renderer, recording), commands, record, stop_level, TexelTarget(target));
  });
}

Outcome<void> record(GpuRenderer& renderer, VkCommandBuffer commands, const FrameRecord& record,
                     int stop_level, const ImageTarget& target, FrameRecording& recording) {
  return guard_device([&] {
    const VkExtent2D extent{static_cast<uint32_t>(record.frame_width),
                            static_cast<uint32_t>(record.frame_height)};
    const TexelTarget place(target, {&extent, 1}, renderer.state()->sizes.texel_bytes, "a frame");
    write_frame(state_for(renderer, recording), commands, record, stop_level, place);
  });
}

}  // namespace hmlfc::gpu
