#include "systemc/driver.hpp"

namespace hmlfc::tb {

void Driver::start(RequestSource source, const Conditions& conditions, uint64_t seed) {
  source_ = std::move(source);
  conditions_ = conditions;
  random_ = Random(seed);
}

void Driver::stop() {
  source_ = nullptr;
  dropped_ = true;
}

void Driver::edge() {
  UnitInputs& next = wires_.next;
  next.response_ready = next.rst_n && !random_.chance(conditions_.backpressure);
  const bool waits = wires_.in.request_valid && !wires_.out.request_ready;
  if (!next.rst_n || dropped_) {
    next.request_valid = false;
    dropped_ = false;
  } else if (!waits) {
    offer_next();
  }
}

void Driver::offer_next() {
  UnitInputs& next = wires_.next;
  next.request_valid = false;
  if (!source_ || random_.chance(conditions_.request_gap)) return;
  const std::optional<Request> request = source_();
  if (!request) {
    source_ = nullptr;
    return;
  }
  next.request_valid = true;
  next.request_data = request->word();
  next.request_last = request->last;
}

}  // namespace hmlfc::tb
