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
  void start(RequestSource source, const Conditions& conditions, uint64_t seed);

  /// Offers no further request; one that is being offered is dropped, as at a reset.
  void stop();

  /// Whether all requests of the source have been taken.
  bool done() const { return !source_; }

 protected:
  void edge() override;

 private:
  void offer_next();

  RequestSource source_;
  Conditions conditions_;
  Random random_{0};
  bool dropped_ = false;
};

}  // namespace hmlfc::tb
