#include "systemc/monitor.hpp"

namespace hmlfc::tb {
namespace {

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
  waits_ = out.response_valid && !wires_.in.response_ready;
  if (waits_) {
    waiting_ = out.answer;
    ++counts_.answer_stalls;
  } else if (out.response_valid) {
    counts_.last_answer = wires_.cycle;
    scoreboard_.on_answer(out.answer, wires_.cycle);
  }
}

}  // namespace hmlfc::tb
