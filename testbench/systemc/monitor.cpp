#include "systemc/monitor.hpp"

#include <bit>

namespace hmlfc::tb {
namespace {

constexpr uint8_t kIncr = 1;
constexpr unsigned kMaxBeats = 16;
constexpr uint64_t kPage = 4096;

bool same(const Answer& a, const Answer& b) {
  return a.status == b.status && a.last == b.last && a.samples == b.samples;
}

}  // namespace

void StreamMonitor::edge() {
  const UnitInputs& in = wires_.in;
  const UnitOutputs& out = wires_.out;
  if (!in.rst_n) {
    waits_ = false;
    return;
  }
  if (scoreboard_.in_flight() != 0) ++counts_.busy;
  if (in.request_valid && out.request_ready) {
    if (scoreboard_.counts().sent == 0) counts_.first_request = wires_.cycle;
    scoreboard_.on_request(Request::of_word(in.request_data, in.request_last), wires_.cycle);
  }
  if (out.trace_valid) scoreboard_.on_record(out.trace, wires_.cycle);
  watch_answer();
}

void StreamMonitor::watch_answer() {
  const UnitOutputs& out = wires_.out;
  if (waits_ && !(out.response_valid && same(out.answer, waiting_))) {
    findings_.add(
        {"protocol: answer changed or went away while it waited", {}, {}, {}, wires_.cycle});
  }
  const bool waited = waits_;
  waits_ = out.response_valid && !wires_.in.response_ready;
  if (waits_) {
    waiting_ = out.answer;
    ++counts_.answer_stalls;
  } else if (out.response_valid) {
    counts_.last_answer = wires_.cycle;
    scoreboard_.on_answer(out.answer, wires_.cycle, waited);
  }
}

void ReadMonitor::edge() {
  const UnitInputs& in = wires_.in;
  const UnitOutputs& out = wires_.out;
  if (!in.rst_n) {
    waits_ = false;
    outstanding_ = 0;
    return;
  }
  const Address address{out.ar_addr, out.ar_len, out.ar_size, out.ar_burst, out.ar_id};
  if (waits_ && !(out.ar_valid && address == waiting_)) {
    broken("read address changed or went away while it waited", {});
  }
  waits_ = out.ar_valid && !in.ar_ready;
  waiting_ = address;
  if (in.r_valid && out.r_ready) {
    ++beats_;
    if (in.r_last) --outstanding_;
  }
  if (out.ar_valid && in.ar_ready) {
    check_address(address);
    coverage_.on_burst(address.addr, (uint64_t{address.len} + 1) * unit_.beat_bytes);
    ++outstanding_;
  }
}

void ReadMonitor::check_address(const Address& address) {
  const std::string detail =
      "address " + std::to_string(address.addr) + ", " + std::to_string(address.len + 1) + " beats";
  const uint64_t bytes = (uint64_t{address.len} + 1) * unit_.beat_bytes;
  if (address.addr % unit_.beat_bytes != 0)
    broken("read address is no multiple of the beat", detail);
  if (address.len + 1u > kMaxBeats) broken("burst of more than 16 beats", detail);
  if (address.size != std::countr_zero(unit_.beat_bytes)) broken("beats are not full", detail);
  if (address.burst != kIncr) broken("burst is not INCR", detail);
  if (address.id != 0) broken("read ID is not 0", detail);
  if (address.addr / kPage != (address.addr + bytes - 1) / kPage) {
    broken("burst crosses 4 KiB", detail);
  }
  if (outstanding_ >= unit_.outstanding) broken("too many bursts on their way", detail);
}

void ReadMonitor::broken(const std::string& rule, const std::string& detail) {
  findings_.add({"protocol: " + rule, {}, {}, detail, wires_.cycle});
}

}  // namespace hmlfc::tb
