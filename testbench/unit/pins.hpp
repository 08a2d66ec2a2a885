// A unit at its pins: the decode unit, the view unit, or the DMA of the view unit.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "oracle/level_record.hpp"
#include "oracle/request.hpp"

namespace hmlfc::tb {

/// A beat of the read master, low word first; words that it does not have are 0.
using Beat = std::array<uint64_t, 4>;

/// Every input of a unit but the clock. A unit ignores those that it does not have.
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
  bool write_aw_ready = false;
  bool write_w_ready = false;
  bool write_b_valid = false;
  uint8_t write_b_resp = 0;
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

/// Every output of a unit. `answer` has meaning while response_valid, `trace` while trace_valid.
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
  bool write_aw_valid = false;
  uint64_t write_aw_addr = 0;
  uint8_t write_aw_len = 0;
  uint8_t write_aw_size = 0;
  uint8_t write_aw_burst = 0;
  bool write_w_valid = false;
  Beat write_w_data{};
  uint32_t write_w_strb = 0;
  bool write_w_last = false;
  bool write_b_ready = false;
  // s_axil_*
  bool aw_ready = false;
  bool w_ready = false;
  bool b_valid = false;
  uint8_t b_resp = 0;
  bool lite_ar_ready = false;
  bool lite_r_valid = false;
  uint32_t lite_r_data = 0;
  uint8_t lite_r_resp = 0;
  // irq
  bool interrupt = false;
  // trace_*
  bool trace_valid = false;
  LevelRecord trace;
};

/// One clocked unit. All handshakes happen at the rising edge between two calls of clock().
class Unit {
 public:
  virtual ~Unit() = default;

  /// One rising edge, at which the unit samples the inputs of the call before; then its inputs
  /// become `inputs`, and `outputs` the values that follow from them.
  virtual void clock(const UnitInputs& inputs, UnitOutputs& outputs) = 0;

  virtual UnitParameters parameters() const = 0;

  /// The seed of what it held before its first reset.
  virtual uint32_t state_seed() const = 0;

  /// Rising edges that it did not get, because it said that it needs none.
  virtual uint64_t stopped_clocks() const = 0;

  /// Writes a wave of everything from now on to `path`; false where the unit has no waves.
  virtual bool open_wave(const std::string& path) = 0;
};

}  // namespace hmlfc::tb
