#include "unit/pin_record.hpp"

namespace hmlfc::tb {
namespace {

std::string hex(const std::string& bits) {
  std::string digits;
  const std::string padded = std::string((4 - bits.size() % 4) % 4, '0') + bits;
  for (size_t i = 0; i < padded.size(); i += 4) {
    unsigned digit = 0;
    for (size_t k = 0; k < 4; ++k) digit = digit * 2 + (padded[i + k] == '1' ? 1 : 0);
    digits += "0123456789abcdef"[digit];
  }
  return digits;
}

}  // namespace

void PinLine::put(std::string& bits, uint64_t value, unsigned count) {
  while (count-- > 0) bits += (value >> count & 1) != 0 ? '1' : '0';
}

void PinLine::out(bool valid, uint64_t value, unsigned bits) {
  const bool has_meaning = valid && on_;
  put(values_, has_meaning ? value : 0, bits);
  put(mask_, has_meaning ? ~uint64_t{0} : 0, bits);
}

void PinLine::in(const Beat& beat, unsigned beat_bytes) {
  if (beat_bytes == 16) in(beat[1], 64);
  in(beat[0], 64);
}

void PinLine::shared(const UnitInputs& in, const UnitOutputs& out, unsigned beat_bytes) {
  this->in(in.ar_ready, 1);
  this->in(in.r_valid, 1);
  this->in(in.r_last, 1);
  this->in(in.r_resp, 2);
  this->in(in.r_id, 1);
  this->in(in.r_data, beat_bytes);
  this->in(in.aw_valid, 1);
  this->in(in.aw_addr, 12);
  this->in(in.w_valid, 1);
  this->in(in.w_data, 32);
  this->in(in.w_strb, 4);
  this->in(in.b_ready, 1);
  this->in(in.lite_ar_valid, 1);
  this->in(in.lite_ar_addr, 12);
  this->in(in.lite_r_ready, 1);
  this->out(true, out.ar_valid, 1);
  this->out(out.ar_valid, out.ar_addr, 40);
  this->out(out.ar_valid, out.ar_len, 8);
  this->out(out.ar_valid, out.ar_size, 3);
  this->out(out.ar_valid, out.ar_burst, 2);
  this->out(out.ar_valid, out.ar_id, 1);
  this->out(true, out.r_ready, 1);
  this->out(true, out.aw_ready, 1);
  this->out(true, out.w_ready, 1);
  this->out(true, out.b_valid, 1);
  this->out(out.b_valid, out.b_resp, 2);
  this->out(true, out.lite_ar_ready, 1);
  this->out(true, out.lite_r_valid, 1);
  this->out(out.lite_r_valid, out.lite_r_data, 32);
  this->out(out.lite_r_valid, out.lite_r_resp, 2);
}

void PinLine::write(std::ostream& stream) const {
  stream << hex(inputs_) << ' ' << hex(values_) << ' ' << hex(mask_) << '\n';
}

void PinRecord::add(const UnitInputs& in, const UnitOutputs& out) {
  PinLine line(in.rst_n);
  line.in(in.request_valid, 1);
  line.in(in.request_last, 1);
  line.in(in.request_data, 64);
  line.in(in.response_ready, 1);
  line.out(true, out.request_ready, 1);
  line.out(true, out.response_valid, 1);
  line.out(out.response_valid, out.answer.last, 1);
  line.out(out.response_valid, out.answer.status, 6);
  for (size_t i = kLanes * unit_.block_size() * unit_.block_size(); i-- > 0;) {
    line.out(out.response_valid, static_cast<uint16_t>(out.answer.samples[i]), 16);
  }
  line.shared(in, out, unit_.beat_bytes);
  line.write(out_);
}

}  // namespace hmlfc::tb
