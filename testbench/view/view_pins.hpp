// The view unit at its pins, independent of what decodes behind them.
#pragma once

#include <cstdint>

#include "unit/pins.hpp"

namespace hmlfc::tb {

/// Every input of the unit but the clock: registers and read master as of the decode unit, whose
/// channels of requests and answers are not used, and the write master.
struct ViewInputs : UnitInputs {
  bool write_aw_ready = false;
  bool write_w_ready = false;
  bool write_b_valid = false;
  uint8_t write_b_resp = 0;
};

/// Every output that the bench looks at.
struct ViewOutputs : UnitOutputs {
  bool write_aw_valid = false;
  uint64_t write_aw_addr = 0;
  uint8_t write_aw_len = 0;
  uint8_t write_aw_size = 0;
  uint8_t write_aw_burst = 0;
  bool write_w_valid = false;
  Beat write_w_data{};
  uint16_t write_w_strb = 0;
  bool write_w_last = false;
  bool write_b_ready = false;
  bool interrupt = false;
};

/// One clocked unit, as DecodeUnit.
class ViewUnit {
 public:
  virtual ~ViewUnit() = default;

  /// One rising edge; then the inputs become `after`, and `outputs` what follows from them.
  virtual void clock(const ViewInputs& after, ViewOutputs& outputs) = 0;

  /// Whether it reads the stream from memory, and LOAD must come first.
  virtual bool reads_stream() const = 0;

  virtual UnitParameters parameters() const = 0;

  /// As of DecodeUnit.
  virtual uint32_t state_seed() const = 0;
  virtual uint64_t stopped_clocks() const = 0;
};

}  // namespace hmlfc::tb
