#include <hmlfc/gpu/recording.hpp>

#include <optional>
#include <string>
#include <utility>

#include "commands.hpp"
#include "image_region.hpp"
#include "render/shown_image.hpp"
#include "stream_renderer.hpp"

namespace hmlfc::gpu {

struct FrameRecording::State {
  explicit State(std::shared_ptr<StreamRenderer> r)
      : renderer(std::move(r)),
        buffers(renderer->device),
        recorder(renderer->device, &buffers.shape()) {}

  std::shared_ptr<StreamRenderer> renderer;
  FrameBuffers buffers;
  Recorder recorder;
  bool refused = false;  // nothing was recorded: the frame does not fit
};

namespace {

// `copy(recorder, texels, bytes)` brings the texels to their target.
template <class Copy>
void record_frame(FrameRecording::State& recording, VkCommandBuffer target,
                  const FrameRecord& record, int stop_level, const Copy& copy) {
  StreamRenderer& renderer = *recording.renderer;
  recording.refused = !fits(record, renderer.header, stop_level);
  if (recording.refused) return;
  FrameForm form = renderer.form_of(record, stop_level);
  form.texel_bytes = renderer.sizes.texel_bytes;
  const KernelUse use = form.geometry ? KernelUse::kGeometryTexels : KernelUse::kFrameTexels;
  renderer.device.kernels->prepare(use, renderer.stream.chunked(), renderer.pool.chunked());
  FrameBuffers& buffers = recording.buffers;
  Recorder& commands = recording.recorder;
  commands.finished();
  buffers.prepare(renderer.device, form);
  buffers.shape().record = record;
  buffers.shape().forget = renderer.pool.take_forget();
  commands.begin(target, {});
  renderer.record(commands, buffers, form);
  buffers.write_shape();
  commands.barrier(kCompute, kTransfer | kHost);
  copy(commands, buffers.drawn(), form.drawn_bytes());
  commands.read_by_host(buffers.results());
  commands.check();
}

// The state of `recording`, of this renderer.
FrameRecording::State& state_for(const GpuRenderer& renderer,
                                 std::unique_ptr<FrameRecording::State>& state) {
  auto stream = GpuRendererAccess::stream(renderer);
  usable(stream->device);
  if (state == nullptr || state->renderer != stream) {
    state.reset();
    state = std::make_unique<FrameRecording::State>(std::move(stream));
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
  const auto words = state_->buffers.counters();
  frame.status = words[kCountFirstError] == kNoError ? ErrorCode::kOk
                                                     : static_cast<ErrorCode>(words[kCountStatus]);
  frame.had_room = words[kCountMode] != kModeNoRoom;
  frame.blocks_needed = words[kCountNeeded];
  frame.blocks_decoded = words[kCountDecoded];
  frame.disparities_looked_up = words[kCountLookedUp];
  return frame;
}

Outcome<void> record(GpuRenderer& renderer, VkCommandBuffer commands, const FrameRecord& record,
                     int stop_level, const BufferTarget& target, FrameRecording& recording) {
  return guard_device([&] {
    const auto copy = [&](Recorder& recorder, const Buffer& texels, uint64_t bytes) {
      recorder.copy_out(texels, bytes, target.buffer, target.offset);
    };
    record_frame(state_for(renderer, recording.state()), commands, record, stop_level, copy);
  });
}

Outcome<void> record(GpuRenderer& renderer, VkCommandBuffer commands, const FrameRecord& record,
                     int stop_level, const ImageTarget& target, FrameRecording& recording) {
  return guard_device([&] {
    if (target.places.size() != 1) {
      throw MachineError(FailureKind::kLimit, "ImageTarget::places has " +
                                                  std::to_string(target.places.size()) +
                                                  " places for a frame");
    }
    const vk::BufferImageCopy region = region_of(
        target, 0, 0,
        {static_cast<uint32_t>(record.frame_width), static_cast<uint32_t>(record.frame_height)});
    const auto copy = [&](Recorder& recorder, const Buffer& texels, uint64_t) {
      recorder.copy_out(texels, target.image, vk::ImageLayout(target.layout), {&region, 1});
    };
    record_frame(state_for(renderer, recording.state()), commands, record, stop_level, copy);
  });
}

}  // namespace hmlfc::gpu
