// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// a * b + c, one bit of b a clock.
//
// `start` takes a, b and c when `idle`; `done` is high for one clock when `sum`, modulo 2^SUM_BITS, is valid; it holds
// until the next start. Latency: as many clocks as b has bits up to its highest 1, and one.
module hmlfc_multiply_add #(
    parameter int A_BITS = 34,
    parameter int B_BITS = 22,
    parameter int SUM_BITS = 44
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input logic [A_BITS-1:0] a,
    input logic [B_BITS-1:0] b,
    input logic [SUM_BITS-1:0] c,
    output logic idle,
    output logic done,
    output logic [SUM_BITS-1:0] sum
);
  // The high half of the sum follows the low one a clock later, with its carry.
  localparam int LOW = SUM_BITS / 2;
  localparam int HIGH = SUM_BITS - LOW;
  logic busy, carry;
  logic [SUM_BITS-1:0] addend;  // a times the weight of the lowest bit in `left`
  logic [HIGH-1:0] high_addend;
  logic [B_BITS-1:0] left;

  assign idle = !busy;
  always_ff @(posedge clk) begin
    done <= 1'b0;
    if (start) begin
      addend <= SUM_BITS'(a);
      left <= b;
      sum <= c;
      {carry, high_addend} <= '0;
      busy <= 1'b1;
    end else if (busy) begin
      {carry, sum[LOW-1:0]} <= {1'b0, sum[LOW-1:0]} + (left[0] ? {1'b0, addend[LOW-1:0]} : (LOW + 1)'(0));
      high_addend <= left[0] ? addend[SUM_BITS-1:LOW] : '0;
      sum[SUM_BITS-1:LOW] <= sum[SUM_BITS-1:LOW] + high_addend + HIGH'(carry);
      addend <= addend << 1;
      left <= left >> 1;
      busy <= left != 0;
      done <= left == 0;
    end
    if (!rst_n) begin
      busy <= 1'b0;
      done <= 1'b0;
    end
  end
endmodule

`default_nettype wire
