#include "systemc/memory.hpp"

#include <algorithm>
#include <cstring>

namespace hmlfc::tb {
namespace {

constexpr size_t kMaxBursts = 64;  // and with a Dram lines
constexpr uint8_t kDecodeError = 3;

}  // namespace

void Memory::start(const Conditions& conditions, uint64_t seed) {
  conditions_ = conditions;
  random_ = Random(seed);
}

void Memory::set_faults(std::vector<FaultyRange> faults) {
  faults_ = std::move(faults);
  failed_.clear();
}

bool Memory::has_failed(uint64_t begin, uint64_t end) const {
  const auto beat = failed_.lower_bound(begin < beat_bytes_ ? 0 : begin - beat_bytes_ + 1);
  return beat != failed_.end() && *beat < end;
}

void Memory::edge() {
  if (!wires_.next.rst_n) {
    if (!keeps_bursts_) bursts_.clear();
    wires_.next.r_valid = false;
    wires_.next.ar_ready = false;
    return;
  }
  const bool waits = wires_.in.r_valid && !wires_.out.r_ready;
  take_address();
  if (!waits) show_beat();
  wires_.next.ar_ready = bursts_.size() < kMaxBursts && !random_.chance(conditions_.address_stall);
}

void Memory::take_address() {
  if (!wires_.out.ar_valid || !wires_.in.ar_ready) return;
  ++counts_.bursts;
  if (listener_) listener_(wires_.out.ar_addr, wires_.out.ar_len + 1u);
  if (dram_ != nullptr) return ask_dram(wires_.out.ar_addr, wires_.out.ar_len + 1u);
  const unsigned jitter = conditions_.latency_jitter;
  const unsigned extra = jitter == 0 ? 0 : random_.below(uint64_t{jitter} + 1);
  bursts_.push_back(
      {wires_.out.ar_addr, wires_.out.ar_len + 1u, wires_.cycle + conditions_.latency + extra});
}

// One entry for each line of the burst.
void Memory::ask_dram(uint64_t address, unsigned beats) {
  while (beats != 0) {
    const uint64_t line_end = (address / Dram::kLineBytes + 1) * Dram::kLineBytes;
    const unsigned here =
        std::min(beats, static_cast<unsigned>((line_end - address) / beat_bytes_));
    beats -= here;
    bursts_.push_back({address, here, dram_->read_line(address, wires_.cycle), beats == 0});
    address = line_end;
  }
}

void Memory::show_beat() {
  UnitInputs& next = wires_.next;
  next.r_valid = false;
  if (bursts_.empty() || bursts_.front().ready_at > wires_.cycle) return;
  if (random_.chance(conditions_.stall)) return;
  Burst& burst = bursts_.front();
  next.r_valid = true;
  next.r_id = 0;
  next.r_resp = 0;
  next.r_last = burst.beats_left == 1 && burst.ends;
  fill(next.r_data, burst.address);
  if (next.r_resp != 0) failed_.insert(burst.address);
  burst.address += beat_bytes_;
  if (--burst.beats_left == 0) bursts_.pop_front();
}

void Memory::fill(Beat& beat, uint64_t address) {
  for (const FaultyRange& fault : faults_) {
    if (address + beat_bytes_ <= fault.begin || address >= fault.end) continue;
    wires_.next.r_resp = fault.response;
    beat = {random_.next(), beat_bytes_ == 16 ? random_.next() : 0};
    return;
  }
  for (const MemoryRegion& region : regions_) {
    const uint64_t at = address - region.base;
    if (address < region.base || at >= region.bytes.size() + AddressSpace::kReadBehind) continue;
    beat = {random_.next(), random_.next()};
    if (at < region.bytes.size()) {
      const size_t held = std::min<size_t>(beat_bytes_, region.bytes.size() - at);
      std::memcpy(beat.data(), region.bytes.data() + at, held);
    }
    if (beat_bytes_ == 8) beat[1] = 0;
    return;
  }
  wires_.next.r_resp = kDecodeError;
  beat = {random_.next(), beat_bytes_ == 16 ? random_.next() : 0};
}

}  // namespace hmlfc::tb
