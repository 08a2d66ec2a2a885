// Offers requests and takes answers.
#pragma once

#include "stimulus/conditions.hpp"
#include "systemc/wires.hpp"

namespace hmlfc::tb {

/// Master of s_request_* and slave of m_response_*: holds a request until it is taken.
class Driver final : public EdgeModule {
 public:
  Driver(const sc_core::sc_module_name& name, Wires& wires) : EdgeModule(name, wires) {}

  /// Sends the requests of `source` from the next edge on.
  void start(RequestSource source, const Conditions& conditions, uint64_t seed) {
    source_ = std::move(source);
    conditions_ = conditions;
    random_ = Random(seed);
  }

  /// Offers no further request; one that is being offered is dropped, as at a reset.
  void stop() {
    source_ = nullptr;
    dropped_ = true;
  }

  /// Whether all requests of the source have been taken.
  bool done() const { return !source_; }

 protected:
  void edge() override {
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

 private:
  void offer_next() {
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

  RequestSource source_;
  Conditions conditions_;
  Random random_{0};
  bool dropped_ = false;
};

}  // namespace hmlfc::tb
