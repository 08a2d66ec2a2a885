#include <hmlfc/gpu/renderer.hpp>

#include <algorithm>
#include <array>
#include <string>

#include "decoder/open_stream.hpp"
#include "frame_slot.hpp"
#include "render/shown_image.hpp"
#include "stream_renderer.hpp"

namespace hmlfc::gpu {

struct GpuRenderer::State : StreamRenderer {
  State(Device::State& d, const StreamView& view, uint64_t cache_bytes)
      : StreamRenderer(d, view, cache_bytes), slots{FrameSlot(d), FrameSlot(d), FrameSlot(d)} {}

  GpuFrame render(const FrameRecord& record, int stop_level) {
    GpuFrame frame;
    begin(record, stop_level, FrameOutput::kHost);
    finish(frame);
    return frame;
  }

  void begin(const FrameRecord& record, int stop_level, FrameOutput output) {
    if (under_way == kFramesUnderWay) {
      throw MachineError(FailureKind::kLimit, std::to_string(kFramesUnderWay) +
                                                  " frames are under way: finish one first");
    }
    const unsigned number = (first + under_way) % kFramesUnderWay;
    refused[number] = !fits(record, header, stop_level);
    if (!refused[number]) {
      FrameSlot& slot = slots[number];
      FrameForm form = form_of(record, stop_level);
      form.output = output;
      slot.buffers().shape().record = record;
      submit(slot, form);
    }
    ++under_way;
  }

  bool ready() { return under_way == 0 || refused[first] || slots[first].commands().done(); }

  void finish(GpuFrame& frame) {
    if (under_way == 0) throw MachineError(FailureKind::kLimit, "no frame is under way");
    last = first;
    first = (first + 1) % kFramesUnderWay;
    --under_way;
    frame.status = ErrorCode::kBadRequest;
    frame.image.samples.clear();
    frame.blocks_needed = frame.blocks_decoded = frame.disparities_looked_up = 0;
    frame.submissions = 0;
    if (refused[last]) return;
    try {
      finish(slots[last], frame);
    } catch (...) {
      pool.forget();
      throw;
    }
  }

  // Submits a frame whose record is in `slot`.
  void submit(FrameSlot& slot, const FrameForm& form) {
    if (slot.prepare(form)) {
      record(slot.commands(), slot.buffers(), form);
      slot.record_output();
      slot.commands().end();
    }
    slot.buffers().shape().forget = pool.take_forget();
    slot.submit();
  }

  // Waits for the frame in `slot`; where it had no room, makes some and submits it once more.
  void finish(FrameSlot& slot, GpuFrame& frame) {
    const auto counters = [&] { return slot.buffers().counters(); };
    slot.commands().wait();
    frame.submissions = 1;
    if (counters()[kCountMode] == kModeNoRoom) {
      for (FrameSlot& other : slots) other.wait();
      make_room(counters()[kCountDecoded], counters()[kCountPages]);
      FrameForm form =
          form_of(slot.buffers().shape().record, static_cast<int>(slot.form().stop_level));
      form.output = slot.form().output;
      submit(slot, form);
      slot.commands().wait();
      frame.submissions = 2;
    }
    if (counters()[kCountMode] == kModeNoRoom) {
      throw MachineError(FailureKind::kInternal,
                         "the device counts other blocks for the same frame");
    }
    collect(slot, frame);
  }

  const std::vector<StageTime>& stage_times() {
    times = slots[last].times();
    return times;
  }

  void collect(const FrameSlot& slot, GpuFrame& frame) const {
    const auto words = slot.buffers().counters();
    frame.blocks_needed = words[kCountNeeded];
    frame.blocks_decoded = words[kCountDecoded];
    frame.disparities_looked_up = words[kCountLookedUp];
    frame.status = ErrorCode::kOk;
    if (words[kCountFirstError] != kNoError) {
      frame.status = static_cast<ErrorCode>(words[kCountStatus]);
      return;
    }
    frame.image.width = static_cast<uint32_t>(slot.form().width);
    frame.image.height = static_cast<uint32_t>(slot.form().height);
    frame.image.depth = header.depth;
    if (slot.form().output == FrameOutput::kDevice) return;
    const size_t row = size_t{3} * frame.image.width;
    frame.image.samples.resize(row * frame.image.height);
    const uint16_t* from = slot.samples().data();
    for (uint32_t y = 0; y < frame.image.height; ++y) {
      std::copy_n(from, row, frame.image.samples.begin() + static_cast<ptrdiff_t>(y * row));
      from += 3 * static_cast<size_t>(slot.form().row_pixels());
    }
  }

  // Frames under way: `under_way` from slot `first` on.
  std::array<FrameSlot, kFramesUnderWay> slots;
  std::array<bool, kFramesUnderWay> refused{};  // nothing was submitted: they do not fit
  unsigned first = 0;
  unsigned under_way = 0;
  unsigned last = 0;  // slot of the last frame finished
  std::vector<StageTime> times;
};

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
  return guard_device([&] { return state_->render(record, stop_level); });
}

Outcome<void> GpuRenderer::begin(const FrameRecord& record, int stop_level, FrameOutput output) {
  return guard_device([&] { state_->begin(record, stop_level, output); });
}

unsigned GpuRenderer::most_under_way() { return kFramesUnderWay; }

unsigned GpuRenderer::under_way() const { return state_->under_way; }

Outcome<bool> GpuRenderer::ready() {
  return guard_device([&] { return state_->ready(); });
}

Outcome<void> GpuRenderer::finish(GpuFrame& frame) {
  return guard_device([&] { state_->finish(frame); });
}

uint64_t GpuRenderer::picture_address() const {
  return state_->slots[state_->last].buffers().drawn().address();
}

void GpuRenderer::forget() { state_->pool.forget(); }

const std::vector<StageTime>& GpuRenderer::stage_times() const { return state_->stage_times(); }

std::shared_ptr<StreamRenderer> GpuRendererAccess::stream(const GpuRenderer& renderer) {
  return renderer.state_;
}

}  // namespace hmlfc::gpu
