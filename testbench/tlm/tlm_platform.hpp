// A small platform around the TLM model: memory, software and a consumer, for tests and crosscheck.
#pragma once

#include "systemc/bench.hpp"
#include "tlm/decode_unit_tlm.hpp"

namespace hmlfc::tb {

/// Runs sequences of requests through the TLM model; answers go to a scoreboard. Several platforms
/// may stand in one process, all made before the simulation starts.
class TlmPlatform final : public sc_core::sc_module {
 public:
  TlmPlatform(const sc_core::sc_module_name& name, const UnitParameters& parameters);

  /// Resets the unit, LOADs `image` and sends the requests of `source`; STATUS after LOAD is
  /// checked against `load_error`.
  void run(const MemoryImage& image, uint8_t load_error, RequestSource source, Oracle& oracle);

  Scoreboard& scoreboard() { return scoreboard_; }
  Findings& findings() { return findings_; }

 private:
  void software();
  void read_memory(tlm::tlm_generic_payload& read, sc_core::sc_time& delay);
  void take_answer(tlm::tlm_generic_payload& write, sc_core::sc_time& delay);
  uint32_t access(tlm::tlm_command command, uint32_t offset, uint32_t value);
  void load();
  void send(const Request& request);

  UnitParameters parameters_;
  Findings findings_;
  Coverage coverage_;
  Scoreboard scoreboard_;
  DecodeUnitTlm unit_;
  tlm_utils::simple_initiator_socket<TlmPlatform> registers_;
  tlm_utils::simple_initiator_socket<TlmPlatform> requests_;
  tlm_utils::simple_target_socket<TlmPlatform> answers_;
  tlm_utils::simple_target_socket<TlmPlatform> memory_;
  sc_core::sc_event start_;
  MemoryImage image_;
  uint8_t load_error_ = 0;
  RequestSource source_;
  bool done_ = true;
  uint64_t answers_taken_ = 0;
};

}  // namespace hmlfc::tb
