#include "unit/unit_host.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "bits/crc32c.hpp"
#include "stimulus/address_space.hpp"
#include "unit/registers.hpp"

namespace hmlfc::tb {
namespace {

constexpr size_t kMaxWaitingBursts = 64;
// Clocks in 1000 that are paused, and for how many clocks it is so.
constexpr unsigned kPause = 250;
constexpr unsigned kLongPause = 937;
constexpr uint64_t kTurn = 512;
constexpr uint64_t kAlignment = 16;  // of stream and reference area

}  // namespace

UnitHost::UnitHost(std::unique_ptr<DecodeUnit> unit, std::span<const uint8_t> stream,
                   std::span<const uint8_t> area, OnClock on_clock)
    : unit_(std::move(unit)), on_clock_(std::move(on_clock)), stream_(stream), area_(area) {
  AddressSpace space(crc32c(stream) ^ unit_->parameters().state_seed);
  const auto place_of = [&](std::span<const uint8_t> bytes) {
    return space.take(std::max<uint64_t>(bytes.size(), 1), kAlignment, AddressSpace::kReadBehind);
  };
  stream_base_ = place_of(stream);
  area_base_ = place_of(area);
  for (int i = 0; i < 4; ++i) clock();
  next_.rst_n = true;
  clock();
}

// A rising edge: the unit samples its inputs, then next_ becomes its inputs.
void UnitHost::clock() {
  read_channel(next_);
  unit_->clock(in_, next_, out_);
  in_ = next_;
  ++clocks_;
  if (on_clock_) on_clock_(in_, out_);
  if (out_.trace_valid && on_record) on_record(out_.trace);
}

bool UnitHost::pause(unsigned permille) { return pauses_ && pauses_->chance(permille); }

// The memory: accepts every burst and returns a beat a clock, except in its pauses.
void UnitHost::read_channel(UnitInputs& next) {
  if (!in_.rst_n) return;
  if (out_.ar_valid && in_.ar_ready) bursts_.push_back({out_.ar_addr, out_.ar_len + 1u});
  next.ar_ready = bursts_.size() < kMaxWaitingBursts && !pause(kPause);
  if (in_.r_valid && !out_.r_ready) return;
  next.r_valid = !bursts_.empty() && !pause(kPause);
  if (!next.r_valid) return;
  Burst& burst = bursts_.front();
  next.r_data = beat_at(burst.address);
  next.r_last = burst.beats_left == 1;
  burst.address += unit_->parameters().beat_bytes;
  if (--burst.beats_left == 0) bursts_.pop_front();
}

Beat UnitHost::beat_at(uint64_t address) const {
  Beat beat{};
  for (const auto& [bytes, base] : {std::pair{stream_, stream_base_}, {area_, area_base_}}) {
    const uint64_t at = address - base;
    if (address < base || at >= bytes.size()) continue;
    const size_t held = std::min<size_t>(unit_->parameters().beat_bytes, bytes.size() - at);
    std::memcpy(beat.data(), bytes.data() + at, held);
  }
  return beat;
}

void UnitHost::write(uint32_t address, uint32_t value) {
  next_.aw_valid = next_.w_valid = next_.b_ready = true;
  next_.aw_addr = address;
  next_.w_data = value;
  next_.w_strb = 15;
  for (uint64_t clocks = 0; next_.aw_valid || next_.w_valid || next_.b_ready; ++clocks) {
    if (clocks == patience_) throw UnitHangs("the unit does not take a register write");
    clock();
    // What is shown and taken now passes at the next edge.
    if (in_.aw_valid && out_.aw_ready) next_.aw_valid = false;
    if (in_.w_valid && out_.w_ready) next_.w_valid = false;
    if (in_.b_ready && out_.b_valid) next_.b_ready = false;
  }
  clock();
}

uint32_t UnitHost::read(uint32_t address) {
  next_.lite_ar_valid = next_.lite_r_ready = true;
  next_.lite_ar_addr = address;
  uint32_t value = 0;
  for (uint64_t clocks = 0; next_.lite_ar_valid || next_.lite_r_ready; ++clocks) {
    if (clocks == patience_) throw UnitHangs("the unit does not answer a register read");
    clock();
    if (in_.lite_ar_valid && out_.lite_ar_ready) next_.lite_ar_valid = false;
    if (in_.lite_r_ready && out_.lite_r_valid) {
      value = out_.lite_r_data;
      next_.lite_r_ready = false;
    }
  }
  clock();
  return value;
}

uint8_t UnitHost::load() {
  reg::write_stream([&](uint32_t address, uint32_t word) { write(address, word); }, stream_base_,
                    stream_.size(), area_base_);
  write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
  for (uint64_t reads = 0; reads < patience_; ++reads) {
    const uint32_t status = read(HMLFC_REG_STATUS);
    if ((status & HMLFC_REG_STATUS_LOADING_MASK) != 0) continue;
    if ((status & HMLFC_REG_STATUS_READY_MASK) != 0) return 0;
    if (reg::load_error(status) != 0) return static_cast<uint8_t>(reg::load_error(status));
  }
  throw UnitHangs("LOAD does not end");
}

std::vector<Answer> UnitHost::answers(std::span<const Request> requests) {
  std::vector<Answer> answers;
  size_t sent = 0;
  for (uint64_t idle = 0; answers.size() < requests.size(); ++idle) {
    if (idle == patience_) throw UnitHangs("a request is not answered");
    const bool slow = (clocks_ / kTurn) % 2 == 1;
    next_.response_ready = !pause(slow ? kLongPause : kPause);
    next_.request_valid = sent < requests.size();
    if (next_.request_valid) {
      next_.request_data = requests[sent].word();
      next_.request_last = sent + 1 == requests.size();
    }
    clock();
    if (in_.request_valid && out_.request_ready) ++sent;
    if (in_.response_ready && out_.response_valid) {
      answers.push_back(out_.answer);
      idle = 0;
    }
  }
  next_.request_valid = next_.response_ready = false;
  clock();
  return answers;
}

}  // namespace hmlfc::tb
