#include "frame_ring.hpp"

#include <algorithm>
#include <string>

#include "render/shown_image.hpp"
#include "renderer_state.hpp"

namespace hmlfc::gpu {

FrameRing::FrameRing(GpuRenderer::State& renderer)
    : renderer_(renderer),
      slots_{Slot(renderer.device), Slot(renderer.device), Slot(renderer.device)} {}

void FrameRing::begin(const FrameRecord& record, int stop_level, FrameOutput output) {
  if (under_way_ == kSlots) {
    throw MachineError(FailureKind::kLimit,
                       std::to_string(kSlots) + " frames are under way: finish one first");
  }
  Slot& slot = slots_[(first_ + under_way_) % kSlots];
  slot.refused = !fits(record, renderer_.header, stop_level);
  if (!slot.refused) {
    FrameForm form = renderer_.form_of(record, stop_level);
    form.output = output;
    slot.buffers.arguments().record = record;
    submit(slot, form);
  }
  ++under_way_;
}

bool FrameRing::ready() {
  return under_way_ == 0 || slots_[first_].refused || slots_[first_].commands->done();
}

void FrameRing::finish(GpuFrame& frame) {
  if (under_way_ == 0) throw MachineError(FailureKind::kLimit, "no frame is under way");
  last_ = first_;
  first_ = (first_ + 1) % kSlots;
  --under_way_;
  frame.status = ErrorCode::kBadRequest;
  frame.image.samples.clear();
  frame.blocks_needed = frame.blocks_decoded = frame.disparities_looked_up = 0;
  frame.submissions = 0;
  if (slots_[last_].refused) return;
  try {
    finish(slots_[last_], frame);
  } catch (...) {
    renderer_.pool.forget();
    throw;
  }
}

const std::vector<StageTime>& FrameRing::stage_times() {
  times_.clear();
  if (auto& commands = slots_[last_].commands) {
    commands->read_times();
    times_ = commands->times();
  }
  return times_;
}

// Submits a frame whose record is in `slot`.
void FrameRing::submit(Slot& slot, const FrameForm& form) {
  slot.form = form;
  // The check of barriers follows every submission.
  if (slot.recorded != form || renderer_.device.hazards) {
    slot.recorded.reset();
    slot.buffers.prepare(renderer_.device, form);
    if (form.output == FrameOutput::kHost) {
      slot.readback.reserve(renderer_.device, form.drawn_bytes());
    }
    if (slot.commands) {
      slot.commands->restart();
    } else {
      slot.commands.emplace(renderer_.device, &slot.buffers.arguments());
    }
    renderer_.write(*slot.commands, slot.buffers, form);
    write_output(slot);
    slot.commands->end();
  }
  slot.buffers.arguments().forget = renderer_.pool.take_forget();
  slot.recorded = form;
  slot.buffers.write_arguments();
  slot.commands->submit();
}

// Writes that the picture comes to the host, if the form says so, and that the host reads the
// results.
void FrameRing::write_output(Slot& slot) {
  Submission& commands = *slot.commands;
  if (slot.form.output == FrameOutput::kHost) {
    commands.barrier(kCompute, kTransfer);
    commands.copy(slot.buffers.drawn(), 0, slot.readback.get(), 0, slot.form.drawn_bytes());
    commands.barrier(kCompute | kTransfer, kHost);
    commands.read_by_host(slot.readback.get());
  } else {
    commands.barrier(kCompute, kHost);
  }
  commands.read_by_host(slot.buffers.results());
}

// Waits for the frame in `slot`. Where it had no room, makes some and submits it once more.
void FrameRing::finish(Slot& slot, GpuFrame& frame) {
  slot.commands->wait();
  frame.submissions = 1;
  if (slot.buffers.counters()[kCountMode] == kModeNoRoom) {
    submit_with_room(slot);
    frame.submissions = 2;
  }
  if (slot.buffers.counters()[kCountMode] == kModeNoRoom) {
    throw MachineError(FailureKind::kInternal, "the device counts other blocks for the same frame");
  }
  collect(slot, frame);
}

void FrameRing::submit_with_room(Slot& slot) {
  for (Slot& other : slots_) {
    if (other.commands) other.commands->wait();
  }
  const auto counters = slot.buffers.counters();
  renderer_.make_room(counters[kCountDecoded], counters[kCountPages]);
  FrameForm form =
      renderer_.form_of(slot.buffers.arguments().record, static_cast<int>(slot.form.stop_level));
  form.output = slot.form.output;
  submit(slot, form);
  slot.commands->wait();
}

void FrameRing::collect(const Slot& slot, GpuFrame& frame) const {
  const auto counters = slot.buffers.counters();
  frame.blocks_needed = counters[kCountNeeded];
  frame.blocks_decoded = counters[kCountDecoded];
  frame.disparities_looked_up = counters[kCountLookedUp];
  frame.status = slot.buffers.status();
  if (frame.status != ErrorCode::kOk) return;
  frame.image.width = static_cast<uint32_t>(slot.form.width);
  frame.image.height = static_cast<uint32_t>(slot.form.height);
  frame.image.depth = renderer_.header.depth;
  if (slot.form.output == FrameOutput::kDevice) return;
  const size_t row = size_t{3} * frame.image.width;
  frame.image.samples.resize(row * frame.image.height);
  const uint16_t* from = slot.readback.get().records<const uint16_t>().data();
  for (uint32_t y = 0; y < frame.image.height; ++y) {
    std::copy_n(from, row, frame.image.samples.begin() + static_cast<ptrdiff_t>(y * row));
    from += 3 * static_cast<size_t>(slot.form.row_pixels());
  }
}

}  // namespace hmlfc::gpu
