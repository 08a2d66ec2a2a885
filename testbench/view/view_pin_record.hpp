// What stands at a view unit's pins, clock by clock, for rtl/kit/view_pin_replay.sv.
#pragma once

#include "unit/pin_record.hpp"
#include "view/view_pins.hpp"

namespace hmlfc::tb {

/// Writes the line of a clock. Written bytes without a strobe have no meaning.
inline void write_pins(const ViewInputs& in, const ViewOutputs& out, unsigned beat_bytes,
                       std::ostream& stream) {
  PinLine line(in.rst_n);
  line.shared(in, out, beat_bytes);
  line.in(in.write_aw_ready, 1);
  line.in(in.write_w_ready, 1);
  line.in(in.write_b_valid, 1);
  line.in(in.write_b_resp, 2);
  line.out(true, out.write_aw_valid, 1);
  line.out(out.write_aw_valid, out.write_aw_addr, 40);
  line.out(out.write_aw_valid, out.write_aw_len, 8);
  line.out(out.write_aw_valid, out.write_aw_size, 3);
  line.out(out.write_aw_valid, out.write_aw_burst, 2);
  line.out(true, out.write_w_valid, 1);
  for (unsigned k = beat_bytes; k-- > 0;) {
    line.out(out.write_w_valid && (out.write_w_strb >> k & 1) != 0,
             out.write_w_data[k / 8] >> 8 * (k % 8), 8);
  }
  line.out(out.write_w_valid, out.write_w_strb, beat_bytes);
  line.out(out.write_w_valid, out.write_w_last, 1);
  line.out(true, out.write_b_ready, 1);
  line.out(true, out.interrupt, 1);
  line.write(stream);
}

}  // namespace hmlfc::tb
