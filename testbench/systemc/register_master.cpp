#include "systemc/register_master.hpp"

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

void RegisterMaster::edge() {
  if (!wires_.next.rst_n) {
    UnitInputs& next = wires_.next;
    next.aw_valid = next.w_valid = next.b_ready = false;
    next.lite_ar_valid = next.lite_r_ready = false;
    state_ = State::kIdle;
  } else if (state_ == State::kWrite) {
    write_edge();
  } else if (state_ == State::kRead) {
    read_edge();
  }
}

void RegisterMaster::write_edge() {
  const UnitInputs& in = wires_.in;
  UnitInputs& next = wires_.next;
  if (in.aw_valid && wires_.out.aw_ready) {
    next.aw_valid = false;
    address_sent_ = true;
  }
  if (in.w_valid && wires_.out.w_ready) {
    next.w_valid = false;
    data_sent_ = true;
  }
  if (!address_sent_ && !next.aw_valid && !random_.chance(kDelayPermille)) {
    next.aw_valid = true;
    next.aw_addr = address_;
  }
  if (!data_sent_ && !next.w_valid && !random_.chance(kDelayPermille)) {
    next.w_valid = true;
    next.w_data = value_;
    next.w_strb = 15;
  }
  if (in.b_ready && wires_.out.b_valid) {
    next.b_ready = false;
    check_response(wires_.out.b_resp);
    state_ = State::kIdle;
    return;
  }
  next.b_ready = in.b_ready || !random_.chance(kDelayPermille);
}

void RegisterMaster::read_edge() {
  const UnitInputs& in = wires_.in;
  UnitInputs& next = wires_.next;
  if (in.lite_ar_valid && wires_.out.lite_ar_ready) {
    next.lite_ar_valid = false;
    address_sent_ = true;
  }
  if (!address_sent_ && !next.lite_ar_valid && !random_.chance(kDelayPermille)) {
    next.lite_ar_valid = true;
    next.lite_ar_addr = address_;
  }
  if (in.lite_r_ready && wires_.out.lite_r_valid) {
    next.lite_r_ready = false;
    value_ = wires_.out.lite_r_data;
    check_response(wires_.out.lite_r_resp);
    state_ = State::kIdle;
    return;
  }
  next.lite_r_ready = in.lite_r_ready || !random_.chance(kDelayPermille);
}

void RegisterMaster::check_response(uint8_t response) {
  if (response == 0) return;
  findings_.add({"registers: response",
                 {},
                 "register " + std::to_string(address_),
                 "expected OKAY, actual " + std::to_string(response),
                 wires_.cycle});
}

}  // namespace hmlfc::tb
