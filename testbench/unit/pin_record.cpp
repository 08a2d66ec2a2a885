#include "unit/pin_record.hpp"

#include <string>

namespace hmlfc::tb {
namespace {

// Bits of a number, from the highest on.
class Bits {
 public:
  void put(uint64_t value, unsigned count) {
    while (count-- > 0) text_ += (value >> count & 1) != 0 ? '1' : '0';
  }

  std::string hex() const {
    std::string digits;
    const std::string padded = std::string((4 - text_.size() % 4) % 4, '0') + text_;
    for (size_t i = 0; i < padded.size(); i += 4) {
      unsigned digit = 0;
      for (size_t k = 0; k < 4; ++k) digit = digit * 2 + (padded[i + k] == '1' ? 1 : 0);
      digits += "0123456789abcdef"[digit];
    }
    return digits;
  }

 private:
  std::string text_;
};

Bits bits_of(const UnitInputs& in, unsigned beat_bytes) {
  Bits bits;
  bits.put(in.rst_n, 1);
  bits.put(in.request_valid, 1);
  bits.put(in.request_last, 1);
  bits.put(in.request_data, 64);
  bits.put(in.response_ready, 1);
  bits.put(in.ar_ready, 1);
  bits.put(in.r_valid, 1);
  bits.put(in.r_last, 1);
  bits.put(in.r_resp, 2);
  bits.put(in.r_id, 1);
  if (beat_bytes == 16) bits.put(in.r_data[1], 64);
  bits.put(in.r_data[0], 64);
  bits.put(in.aw_valid, 1);
  bits.put(in.aw_addr, 12);
  bits.put(in.w_valid, 1);
  bits.put(in.w_data, 32);
  bits.put(in.w_strb, 4);
  bits.put(in.b_ready, 1);
  bits.put(in.lite_ar_valid, 1);
  bits.put(in.lite_ar_addr, 12);
  bits.put(in.lite_r_ready, 1);
  return bits;
}

// The outputs, and the bits of them that have a meaning.
class OutputBits {
 public:
  void put(bool valid, uint64_t value, unsigned count) {
    values.put(valid ? value : 0, count);
    mask.put(valid ? ~uint64_t{0} : 0, count);
  }
  Bits values, mask;
};

OutputBits bits_of(const UnitOutputs& out, unsigned block_size, bool in_reset) {
  OutputBits bits;
  const bool on = !in_reset;
  const bool answer = on && out.response_valid;
  bits.put(on, out.request_ready, 1);
  bits.put(on, out.response_valid, 1);
  bits.put(answer, out.answer.last, 1);
  bits.put(answer, out.answer.status, 6);
  for (size_t i = kLanes * block_size * block_size; i-- > 0;) {
    bits.put(answer, static_cast<uint16_t>(out.answer.samples[i]), 16);
  }
  const bool address = on && out.ar_valid;
  bits.put(on, out.ar_valid, 1);
  bits.put(address, out.ar_addr, 40);
  bits.put(address, out.ar_len, 8);
  bits.put(address, out.ar_size, 3);
  bits.put(address, out.ar_burst, 2);
  bits.put(address, out.ar_id, 1);
  bits.put(on, out.r_ready, 1);
  bits.put(on, out.aw_ready, 1);
  bits.put(on, out.w_ready, 1);
  bits.put(on, out.b_valid, 1);
  bits.put(on && out.b_valid, out.b_resp, 2);
  bits.put(on, out.lite_ar_ready, 1);
  bits.put(on, out.lite_r_valid, 1);
  bits.put(on && out.lite_r_valid, out.lite_r_data, 32);
  bits.put(on && out.lite_r_valid, out.lite_r_resp, 2);
  return bits;
}

}  // namespace

void PinRecord::add(const UnitInputs& in, const UnitOutputs& out) {
  const OutputBits outputs = bits_of(out, unit_.block_size(), !in.rst_n);
  out_ << bits_of(in, unit_.beat_bytes).hex() << ' ' << outputs.values.hex() << ' '
       << outputs.mask.hex() << '\n';
}

}  // namespace hmlfc::tb
