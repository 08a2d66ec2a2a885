#include "view/view_memory.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace hmlfc::tb {
namespace {

constexpr size_t kMaxBursts = 16;  // that wait in a channel
constexpr uint64_t kLineBytes = 64;
constexpr uint64_t kPageBytes = 4096;
constexpr uint8_t kSlaveError = 2;
constexpr uint8_t kDecodeError = 3;

bool overlaps(const std::optional<ViewMemory::Fault>& fault, uint64_t begin, uint64_t bytes) {
  return fault && begin < fault->end && begin + bytes > fault->begin;
}

}  // namespace

void ViewMemory::start(const Conditions& conditions, uint64_t seed, unsigned beat_bytes) {
  conditions_ = conditions;
  random_ = Random(seed);
  beat_bytes_ = beat_bytes;
}

void ViewMemory::check(bool holds, const char* rule) {
  if (!holds && finding.empty()) finding = std::string("protocol: ") + rule;
}

uint64_t ViewMemory::later() {
  return cycle_ + conditions_.latency + random_.below(uint64_t{conditions_.latency_jitter} + 1);
}

void ViewMemory::edge(const ViewInputs& in, const ViewOutputs& out, ViewInputs& next) {
  ++cycle_;
  const bool beat_waits = in.rst_n && in.r_valid && !out.r_ready;
  const bool response_waits = in.rst_n && in.write_b_valid && !out.write_b_ready;
  if (!in.rst_n || !next.rst_n) {
    for (auto& reads : reads_) reads.clear();
    addresses_.clear();
    beats_.clear();
    responses_.clear();
    ar_waited_ = aw_waited_ = w_waited_ = false;
    next.ar_ready = next.r_valid = false;
    next.write_aw_ready = next.write_w_ready = next.write_b_valid = false;
    return;
  }
  check_stable(in, out);
  take(in, out);
  write_bursts();
  if (!beat_waits) show_beat(next);
  if (!response_waits) {
    next.write_b_valid = !responses_.empty() && responses_.front().ready_at <= cycle_;
    if (next.write_b_valid) {
      next.write_b_resp = responses_.front().value;
      responses_.pop_front();
    }
  }
  next.ar_ready = reads_[0].size() + reads_[1].size() < 4 * kMaxBursts &&
                  !random_.chance(conditions_.address_stall);
  next.write_aw_ready =
      addresses_.size() < kMaxBursts && !random_.chance(conditions_.address_stall);
  next.write_w_ready = beats_.size() < kMaxBursts && !random_.chance(conditions_.backpressure);
}

// What was offered and not taken is offered unchanged.
void ViewMemory::check_stable(const ViewInputs& in, const ViewOutputs& out) {
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
  before_ = out;
}

void ViewMemory::take(const ViewInputs& in, const ViewOutputs& out) {
  if (out.ar_valid && in.ar_ready) {
    const unsigned beats = out.ar_len + 1u;
    check(out.ar_burst == 1 && 1u << out.ar_size == beat_bytes_ && out.ar_addr % beat_bytes_ == 0,
          "a read burst is not INCR of whole beats");
    check(out.ar_addr / kPageBytes == (out.ar_addr + beats * beat_bytes_ - 1) / kPageBytes,
          "a read burst crosses 4 KiB");
    reads_[out.ar_id & 1].push_back({out.ar_addr, beats, later()});
    cover(out.ar_addr, uint64_t{beats} * beat_bytes_);
  }
  if (out.write_aw_valid && in.write_aw_ready) {
    const unsigned beats = out.write_aw_len + 1u;
    const uint64_t begin = out.write_aw_addr;
    check(out.write_aw_burst == 1 && 1u << out.write_aw_size == beat_bytes_ &&
              begin % beat_bytes_ == 0,
          "a write burst is not INCR of whole beats");
    check(begin / kLineBytes == (begin + beats * beat_bytes_ - 1) / kLineBytes,
          "a write burst leaves its line");
    addresses_.push_back({begin, beats});
  }
  if (out.write_w_valid && in.write_w_ready) {
    check(out.write_w_strb >> beat_bytes_ == 0, "a strobe is outside the beat");
    beats_.push_back({out.write_w_data, out.write_w_strb, out.write_w_last});
    ++write_beats;
  }
}

// Bursts of which the address and all beats have come.
void ViewMemory::write_bursts() {
  while (!addresses_.empty() && beats_.size() >= addresses_.front().beats) {
    const auto [begin, count] = addresses_.front();
    addresses_.pop_front();
    const bool failed = overlaps(fault, begin, uint64_t{count} * beat_bytes_);
    cover(begin, uint64_t{count} * beat_bytes_);
    for (unsigned i = 0; i < count; ++i) {
      const Beats beat = beats_.front();
      beats_.pop_front();
      check(beat.last == (i + 1 == count), "WLAST is not at the last beat");
      check(beat.strobe != 0 || (i != 0 && i + 1 != count), "a burst ends with an empty beat");
      uint8_t data[sizeof(Beat)];
      std::memcpy(data, beat.data.data(), sizeof(data));
      for (unsigned k = 0; k < beat_bytes_; ++k) {
        const uint64_t at = begin + i * beat_bytes_ + k;
        if ((beat.strobe >> k & 1) == 0) continue;
        const bool there = content.find(at) != nullptr;
        check(there, "a write is outside the memory");
        if (there) content.at(at)[0] = data[k];
        ++bytes_written;
      }
    }
    failed_writes += failed ? 1 : 0;
    responses_.push_back({later(), failed ? kSlaveError : uint8_t{0}});
  }
}

void ViewMemory::show_beat(ViewInputs& next) {
  next.r_valid = false;
  if (random_.chance(conditions_.stall)) return;
  const unsigned first = random_.below(2);
  for (const unsigned id : {first, 1 - first}) {
    auto& reads = reads_[id];
    if (reads.empty() || reads.front().ready_at > cycle_) continue;
    Read& read = reads.front();
    next.r_valid = true;
    next.r_id = static_cast<uint8_t>(id);
    next.r_last = read.beats_left == 1;
    this->read(read.address, next);
    bytes_read += beat_bytes_;
    read.address += beat_bytes_;
    if (--read.beats_left == 0) reads.pop_front();
    return;
  }
}

// A beat's data and response.
void ViewMemory::read(uint64_t address, ViewInputs& next) {
  next.r_data = {random_.next(), beat_bytes_ == 16 ? random_.next() : 0};
  next.r_resp = 0;
  if (overlaps(fault, address, beat_bytes_)) {
    next.r_resp = kSlaveError;
  } else if (content.find(address) != nullptr) {
    const std::span<const uint8_t> bytes = std::as_const(content).at(address);
    std::memcpy(next.r_data.data(), bytes.data(), std::min<size_t>(beat_bytes_, bytes.size()));
  } else if (address < AddressSpace::kReadBehind ||
             content.find(address - AddressSpace::kReadBehind) == nullptr) {
    next.r_resp = kDecodeError;
  }
}

// A burst that begins in no place is of none.
void ViewMemory::cover(uint64_t address, uint64_t bytes) {
  const SparseBytes::Place* place = content.find(address);
  if (place == nullptr) return;
  coverage[static_cast<size_t>(place->kind)].on_burst(place->address, address, bytes);
}

}  // namespace hmlfc::tb
