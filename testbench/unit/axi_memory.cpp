#include "unit/axi_memory.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "stimulus/address_space.hpp"

namespace hmlfc::tb {
namespace {

constexpr size_t kMaxReads = 64;   // bursts that wait, and with a Dram lines
constexpr size_t kMaxWrites = 16;  // that wait in a channel
constexpr unsigned kMaxBeats = 16;
constexpr uint64_t kLineBytes = 64;
constexpr uint64_t kPageBytes = 4096;
constexpr uint8_t kIncr = 1;
constexpr uint8_t kSlaveError = 2;
constexpr uint8_t kDecodeError = 3;

}  // namespace

void AxiMemory::start(const Conditions& conditions, uint64_t seed) {
  conditions_ = conditions;
  random_ = Random(seed);
}

void AxiMemory::set_faults(std::vector<FaultyRange> faults) {
  faults_ = std::move(faults);
  failed_.clear();
}

bool AxiMemory::has_failed(uint64_t begin, uint64_t end) const {
  const uint64_t beat_bytes = unit_.beat_bytes;
  const auto beat = failed_.lower_bound(begin < beat_bytes ? 0 : begin - beat_bytes + 1);
  return beat != failed_.end() && *beat < end;
}

const FaultyRange* AxiMemory::fault_in(uint64_t begin, uint64_t bytes) const {
  const auto found = std::ranges::find_if(faults_, [&](const FaultyRange& fault) {
    return begin < fault.end && begin + bytes > fault.begin;
  });
  return found == faults_.end() ? nullptr : &*found;
}

void AxiMemory::check(bool holds, const char* rule) {
  if (!holds && finding.empty()) finding = std::string("protocol: ") + rule;
}

uint64_t AxiMemory::later() {
  const unsigned jitter = conditions_.latency_jitter;
  const unsigned more = jitter == 0 ? 0 : random_.below(uint64_t{jitter} + 1);
  return cycle_ + conditions_.latency + more;
}

void AxiMemory::edge(const UnitInputs& in, const UnitOutputs& out, UnitInputs& next) {
  ++cycle_;
  if (!in.rst_n || !next.rst_n) return reset(next);
  const bool beat_waits = in.r_valid && !out.r_ready;
  const bool response_waits = in.write_b_valid && !out.write_b_ready;
  if (in.r_valid && out.r_ready && in.r_last && outstanding_[in.r_id] != 0) {
    --outstanding_[in.r_id];
  }
  check_stable(in, out);
  if (out.ar_valid && in.ar_ready) take_read(out);
  take_write(in, out);
  write_bursts();
  if (!beat_waits) show_beat(next);
  if (!response_waits) {
    next.write_b_valid = !mute_ && !responses_.empty() && responses_.front().ready_at <= cycle_;
    if (next.write_b_valid) {
      next.write_b_resp = responses_.front().value;
      responses_.pop_front();
    }
  }
  next.ar_ready =
      reads_[0].size() + reads_[1].size() < kMaxReads && !random_.chance(conditions_.address_stall);
  next.write_aw_ready =
      addresses_.size() < kMaxWrites && !random_.chance(conditions_.address_stall);
  next.write_w_ready = beats_.size() < kMaxWrites && !random_.chance(conditions_.backpressure);
}

void AxiMemory::reset(UnitInputs& next) {
  if (!keeps_bursts_) {
    for (auto& reads : reads_) reads.clear();
  }
  outstanding_[0] = outstanding_[1] = 0;
  addresses_.clear();
  beats_.clear();
  responses_.clear();
  ar_waited_ = aw_waited_ = w_waited_ = false;
  next.ar_ready = next.r_valid = false;
  next.write_aw_ready = next.write_w_ready = next.write_b_valid = false;
}

// What was offered and not taken is offered unchanged.
void AxiMemory::check_stable(const UnitInputs& in, const UnitOutputs& out) {
  check(!ar_waited_ || (out.ar_valid && out.ar_addr == before_.ar_addr &&
                        out.ar_len == before_.ar_len && out.ar_id == before_.ar_id),
        "a read address changed while it waited");
  check(!aw_waited_ || (out.write_aw_valid && out.write_aw_addr == before_.write_aw_addr &&
                        out.write_aw_len == before_.write_aw_len),
        "a write address changed while it waited");
  check(!w_waited_ ||
            (out.write_w_valid && out.write_w_data == before_.write_w_data &&
             out.write_w_strb == before_.write_w_strb && out.write_w_last == before_.write_w_last),
        "write data changed while they waited");
  ar_waited_ = out.ar_valid && !in.ar_ready;
  aw_waited_ = out.write_aw_valid && !in.write_aw_ready;
  w_waited_ = out.write_w_valid && !in.write_w_ready;
  if (ar_waited_ || aw_waited_ || w_waited_) before_ = out;
}

void AxiMemory::take_read(const UnitOutputs& out) {
  const unsigned beats = out.ar_len + 1u;
  const uint64_t bytes = uint64_t{beats} * unit_.beat_bytes;
  check(out.ar_burst == kIncr && 1u << out.ar_size == unit_.beat_bytes &&
            out.ar_addr % unit_.beat_bytes == 0,
        "a read burst is not INCR of whole beats");
  check(beats <= kMaxBeats, "a read burst has more than 16 beats");
  check(out.ar_addr / kPageBytes == (out.ar_addr + bytes - 1) / kPageBytes,
        "a read burst crosses 4 KiB");
  unsigned& outstanding = outstanding_[out.ar_id & 1];
  check(outstanding < unit_.outstanding, "too many bursts are on their way");
  ++outstanding;
  ++read_bursts;
  if (listener_) listener_(out.ar_addr, beats);
  std::deque<Read>& reads = reads_[out.ar_id & 1];
  if (dram_ != nullptr) return ask_dram(reads, out.ar_addr, beats);
  reads.push_back({out.ar_addr, beats, later()});
}

// One entry for each line of the burst.
void AxiMemory::ask_dram(std::deque<Read>& reads, uint64_t address, unsigned beats) {
  while (beats != 0) {
    const uint64_t line_end = (address / Dram::kLineBytes + 1) * Dram::kLineBytes;
    const unsigned here =
        std::min(beats, static_cast<unsigned>((line_end - address) / unit_.beat_bytes));
    beats -= here;
    reads.push_back({address, here, dram_->read_line(address, cycle_), beats == 0});
    address = line_end;
  }
}

void AxiMemory::take_write(const UnitInputs& in, const UnitOutputs& out) {
  if (out.write_aw_valid && in.write_aw_ready) {
    const unsigned beats = out.write_aw_len + 1u;
    const uint64_t begin = out.write_aw_addr;
    check(out.write_aw_burst == kIncr && 1u << out.write_aw_size == unit_.beat_bytes &&
              begin % unit_.beat_bytes == 0,
          "a write burst is not INCR of whole beats");
    check(begin / kLineBytes == (begin + beats * unit_.beat_bytes - 1) / kLineBytes,
          "a write burst leaves its line");
    addresses_.push_back({begin, beats});
  }
  if (out.write_w_valid && in.write_w_ready) {
    check(uint64_t{out.write_w_strb} >> unit_.beat_bytes == 0, "a strobe is outside the beat");
    beats_.push_back({out.write_w_data, out.write_w_strb, out.write_w_last});
    ++write_beats;
  }
}

// Bursts of which the address and all beats have come.
void AxiMemory::write_bursts() {
  while (!addresses_.empty() && beats_.size() >= addresses_.front().beats) {
    const auto [begin, count] = addresses_.front();
    addresses_.pop_front();
    const bool failed = fault_in(begin, uint64_t{count} * unit_.beat_bytes) != nullptr;
    for (unsigned i = 0; i < count; ++i) {
      const WriteBeat beat = beats_.front();
      beats_.pop_front();
      check(beat.last == (i + 1 == count), "WLAST is not at the last beat");
      check(beat.strobe != 0 || (i != 0 && i + 1 != count), "a burst ends with an empty beat");
      uint8_t data[sizeof(Beat)];
      std::memcpy(data, beat.data.data(), sizeof(data));
      for (unsigned k = 0; k < unit_.beat_bytes; ++k) {
        const uint64_t at = begin + i * unit_.beat_bytes + k;
        if ((beat.strobe >> k & 1) == 0) continue;
        const bool there = content.has(at);
        check(there, "a write is outside the memory");
        if (there) content.at(at)[0] = data[k];
        ++bytes_written;
      }
    }
    failed_writes += failed ? 1 : 0;
    responses_.push_back({later(), failed ? kSlaveError : uint8_t{0}});
  }
}

void AxiMemory::show_beat(UnitInputs& next) {
  next.r_valid = false;
  if (reads_[0].empty() && reads_[1].empty()) return;
  if (mute_ || random_.chance(conditions_.stall)) return;
  const unsigned first = reads_[0].empty() || reads_[1].empty() ? 0 : random_.below(2);
  for (const unsigned id : {first, 1 - first}) {
    auto& reads = reads_[id];
    if (reads.empty() || reads.front().ready_at > cycle_) continue;
    Read& read = reads.front();
    next.r_valid = true;
    next.r_id = static_cast<uint8_t>(id);
    next.r_last = read.beats_left == 1 && read.ends;
    fill_beat(read.address, next);
    bytes_read += unit_.beat_bytes;
    read.address += unit_.beat_bytes;
    if (--read.beats_left == 0) reads.pop_front();
    return;
  }
}

// A beat's data and response.
void AxiMemory::fill_beat(uint64_t address, UnitInputs& next) {
  const unsigned beat_bytes = unit_.beat_bytes;
  next.r_data = {};
  for (unsigned i = 0; i < beat_bytes / 8; ++i) next.r_data[i] = random_.next();
  next.r_resp = 0;
  if (const FaultyRange* fault = fault_in(address, beat_bytes)) {
    next.r_resp = fault->response;
  } else if (content.has(address)) {
    const std::span<const uint8_t> bytes = std::as_const(content).at(address);
    std::memcpy(next.r_data.data(), bytes.data(), std::min<size_t>(beat_bytes, bytes.size()));
  } else if (!content.has(address, AddressSpace::read_behind(beat_bytes))) {
    next.r_resp = kDecodeError;
  }
  if (next.r_resp != 0) failed_.insert(address);
}

}  // namespace hmlfc::tb
