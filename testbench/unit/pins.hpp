// The decode unit at its pins, independent of the implementation behind them.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "oracle/level_record.hpp"
#include "oracle/request.hpp"

namespace hmlfc::tb {

/// A beat of the read master, low word first; with 64-bit data the second word is 0.
using Beat = std::array<uint64_t, 2>;

/// Every input of the unit but the clock.
struct UnitInputs {
  bool rst_n = false;
  // s_request_*
  bool request_valid = false;
  uint64_t request_data = 0;
  bool request_last = false;
  // m_response_*
  bool response_ready = false;
  // m_axi_*
  bool ar_ready = false;
  bool r_valid = false;
  Beat r_data{};
  uint8_t r_resp = 0;
  bool r_last = false;
  uint8_t r_id = 0;
  // s_axil_*
  bool aw_valid = false;
  uint32_t aw_addr = 0;
  bool w_valid = false;
  uint32_t w_data = 0;
  uint8_t w_strb = 0;
  bool b_ready = false;
  bool lite_ar_valid = false;
  uint32_t lite_ar_addr = 0;
  bool lite_r_ready = false;
};

/// Every output of the unit. `answer` has meaning while response_valid, `trace` while trace_valid.
struct UnitOutputs {
  // s_request_*
  bool request_ready = false;
  // m_response_*
  bool response_valid = false;
  Answer answer;
  // m_axi_*
  bool ar_valid = false;
  uint64_t ar_addr = 0;
  uint8_t ar_len = 0;
  uint8_t ar_size = 0;
  uint8_t ar_burst = 0;
  uint8_t ar_id = 0;
  bool r_ready = false;
  // s_axil_*
  bool aw_ready = false;
  bool w_ready = false;
  bool b_valid = false;
  uint8_t b_resp = 0;
  bool lite_ar_ready = false;
  bool lite_r_valid = false;
  uint32_t lite_r_data = 0;
  uint8_t lite_r_resp = 0;
  // trace_*
  bool trace_valid = false;
  LevelRecord trace;
};

/// One clocked unit. All handshakes happen at the rising edge between two calls of clock().
class DecodeUnit {
 public:
  virtual ~DecodeUnit() = default;

  /// One rising edge, at which the unit samples `at_edge`; then its inputs become `after`, and
  /// `outputs` the values that follow from them.
  virtual void clock(const UnitInputs& at_edge, const UnitInputs& after, UnitOutputs& outputs) = 0;

  /// Whether it has the trace port.
  virtual bool has_trace() const = 0;

  /// Whether a trace has the blocks of answers with an error, too.
  virtual bool traces_errors() const { return true; }

  virtual UnitParameters parameters() const = 0;

  /// The seed of what it held before its first reset; 0 where that is not random.
  virtual uint32_t state_seed() const { return 0; }

  /// Rising edges that it did not get, because it said that it needs none.
  virtual uint64_t stopped_clocks() const { return 0; }

  /// Writes a wave of everything from now on to `path`; false where the unit has no waves.
  virtual bool open_wave(const std::string& path) {
    static_cast<void>(path);
    return false;
  }
};

}  // namespace hmlfc::tb
