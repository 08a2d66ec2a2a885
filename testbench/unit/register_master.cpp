#include "unit/register_master.hpp"

namespace hmlfc::tb {
namespace {

constexpr unsigned kDelayPermille = 300;

}  // namespace

void RegisterMaster::start_write(uint32_t address, uint32_t value) {
  state_ = State::kWrite;
  address_ = address;
  value_ = value;
  address_sent_ = data_sent_ = false;
}

void RegisterMaster::start_read(uint32_t address) {
  state_ = State::kRead;
  address_ = address;
  address_sent_ = false;
}

void RegisterMaster::edge(const UnitInputs& in, const UnitOutputs& out, UnitInputs& next) {
  if (!next.rst_n) {
    next.aw_valid = next.w_valid = next.b_ready = false;
    next.lite_ar_valid = next.lite_r_ready = false;
    state_ = State::kIdle;
  } else if (state_ == State::kWrite) {
    write_edge(in, out, next);
  } else if (state_ == State::kRead) {
    read_edge(in, out, next);
  }
}

bool RegisterMaster::waits() { return random_.chance(kDelayPermille); }

void RegisterMaster::write_edge(const UnitInputs& in, const UnitOutputs& out, UnitInputs& next) {
  if (in.aw_valid && out.aw_ready) {
    next.aw_valid = false;
    address_sent_ = true;
  }
  if (in.w_valid && out.w_ready) {
    next.w_valid = false;
    data_sent_ = true;
  }
  if (!address_sent_ && !next.aw_valid && !waits()) {
    next.aw_valid = true;
    next.aw_addr = address_;
  }
  if (!data_sent_ && !next.w_valid && !waits()) {
    next.w_valid = true;
    next.w_data = value_;
    next.w_strb = 15;
  }
  if (in.b_ready && out.b_valid) {
    next.b_ready = false;
    return end(out.b_resp);
  }
  next.b_ready = in.b_ready || !waits();
}

void RegisterMaster::read_edge(const UnitInputs& in, const UnitOutputs& out, UnitInputs& next) {
  if (in.lite_ar_valid && out.lite_ar_ready) {
    next.lite_ar_valid = false;
    address_sent_ = true;
  }
  if (!address_sent_ && !next.lite_ar_valid && !waits()) {
    next.lite_ar_valid = true;
    next.lite_ar_addr = address_;
  }
  if (in.lite_r_ready && out.lite_r_valid) {
    next.lite_r_ready = false;
    value_ = out.lite_r_data;
    return end(out.lite_r_resp);
  }
  next.lite_r_ready = in.lite_r_ready || !waits();
}

void RegisterMaster::end(uint8_t response) {
  state_ = State::kIdle;
  if (response == 0 || !finding.empty()) return;
  finding = "registers: response of " + std::to_string(address_) + ": expected OKAY, actual " +
            std::to_string(response);
}

}  // namespace hmlfc::tb
