// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Unsigned division, STEP bits of the quotient a clock.
//
// `start` takes dividend and divisor (at least 1) when `idle`; `done` is high for one clock, QUOTIENT_BITS / STEP clocks
// later, when `quotient`, the floor, is valid; it holds until the next start. A quotient of more bits than that is any
// number.
module hmlfc_divide #(
    parameter int WIDTH = 22,  // of the dividend
    parameter int DIVISOR_BITS = WIDTH,
    parameter int QUOTIENT_BITS = WIDTH,  // a multiple of STEP
    parameter int STEP = 1
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input logic [WIDTH-1:0] dividend,
    input logic [DIVISOR_BITS-1:0] divisor,
    output logic idle,
    output logic done,
    output logic [QUOTIENT_BITS-1:0] quotient
);
  logic [DIVISOR_BITS-1:0] rest, by;
  localparam int CLOCKS = QUOTIENT_BITS / STEP;
  logic [$clog2(CLOCKS+1)-1:0] left;
  logic [DIVISOR_BITS-1:0] next_rest;
  logic [QUOTIENT_BITS-1:0] next_quotient;
  always_comb begin
    logic [DIVISOR_BITS:0] next;  // the rest with the next bit of the dividend; the quotient grows where that was
    logic fits;
    next_rest = rest;
    next_quotient = quotient;
    for (int i = 0; i < STEP; i++) begin
      next = {next_rest, next_quotient[QUOTIENT_BITS-1]};
      fits = next >= {1'b0, by};
      next_rest = fits ? DIVISOR_BITS'(next - {1'b0, by}) : next[DIVISOR_BITS-1:0];
      next_quotient = {next_quotient[QUOTIENT_BITS-2:0], fits};
    end
  end

  assign idle = left == 0;
  always_ff @(posedge clk) begin
    done <= 1'b0;
    if (start) begin
      rest <= DIVISOR_BITS'(dividend >> QUOTIENT_BITS);  // less than the divisor, where the quotient has its bits
      quotient <= dividend[QUOTIENT_BITS-1:0];
      by <= divisor;
      left <= ($clog2(CLOCKS + 1))'(CLOCKS);
    end else if (left != 0) begin
      rest <= next_rest;
      quotient <= next_quotient;
      left <= left - 1'b1;
      done <= left == 1;
    end
    if (!rst_n) begin
      left <= '0;
      done <= 1'b0;
    end
  end
endmodule

`default_nettype wire
