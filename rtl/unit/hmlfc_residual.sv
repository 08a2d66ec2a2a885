// SPDX-License-Identifier: BSD-3-Clause
// The residuals of a block, or of some of its rows, from its BISE values (TIL-10, STP-3).
//
// BLOCK_LOG2   [1, 3], B = 2^BLOCK_LOG2
// ROWS         [1, B], of the block in a clock
// MAX_DEPTH    [8, 12]; values and residuals have MAX_DEPTH + 2 bits, position (x, y) is number
//              y * B + x
//
// values       in [0, N - 1], unsigned
// level_code   [0, 27 + 3 * (depth - 8)]
// bias         [-2^(depth + 1), 2^(depth + 1) - 1], in two's complement
// step_code    [0, 15]; 0 without residual_step
// chroma       the plane is Co or Cg
// depth        [8, MAX_DEPTH]
// residuals    in [-M, M], in two's complement
//
// Latency 4 clocks with advance, ROWS rows a clock: what all positions share; centred; once or three times; shifted and
// clamped.
//
// The step is m * 2^k with m = 1 or 3 (STP-2), and at least 1, so a number outside [-M, M] stays outside when it is
// multiplied: of the clamps (CNV-2) before and after the product, the second alone decides. And m * c * 2^k > M just if
// m * c > M >> k, so the comparison does not wait for the shift.
`include "hmlfc_tables.svh"
`default_nettype none

module hmlfc_residual #(
    parameter int BLOCK_LOG2 = 2,
    parameter int ROWS = 1 << BLOCK_LOG2,
    parameter int MAX_DEPTH = 8
) (
    input logic clk,
    input logic advance,
    input logic [(ROWS<<BLOCK_LOG2)*(MAX_DEPTH+2)-1:0] values,
    input logic [5:0] level_code,
    input logic [MAX_DEPTH+1:0] bias,
    input logic [3:0] step_code,
    input logic chroma,
    input logic [3:0] depth,
    output logic [(ROWS<<BLOCK_LOG2)*(MAX_DEPTH+2)-1:0] residuals
);
  localparam integer SAMPLES = ROWS << BLOCK_LOG2;
  localparam integer VALUE_BITS = MAX_DEPTH + 2;
  localparam integer SUM_BITS = MAX_DEPTH + 3;   // value - (N >> 1) + bias
  localparam integer ODD_BITS = MAX_DEPTH + 5;   // three times that

  // First stage: bias - (N >> 1), the step, M of STR-7.
  // Not all bits are used: N >> 1 drops the low bit, a small MAX_DEPTH the high ones.
  logic [14:0]                   level_count;
  logic [VALUE_BITS-1:0]         largest;
  logic [SAMPLES*VALUE_BITS-1:0] values_1;
  logic [SUM_BITS-1:0]           offset_1;
  logic                          thrice_1;
  logic [3:0]                    shift_1;  // k
  logic [VALUE_BITS-1:0]         bound_1;  // M

  assign level_count = hmlfc_level_count(level_code);
  assign largest = ~({VALUE_BITS{1'b1}} << depth);

  always_ff @(posedge clk) begin
    if (advance) begin
      values_1 <= values;
      offset_1 <= {bias[VALUE_BITS-1], bias} - {1'b0, level_count[VALUE_BITS:1]};
      // Code 0: 1; odd c: 2^((c + 1) / 2); even c: 3 * 2^((c - 2) / 2). step_code[3:1] is floor(c / 2).
      thrice_1 <= !step_code[0] && step_code != 4'd0;
      shift_1 <= step_code == 4'd0 ? 4'd0
               : step_code[0] ? {1'b0, step_code[3:1]} + 4'd1 : {1'b0, step_code[3:1]} - 4'd1;
      bound_1 <= chroma ? {largest[VALUE_BITS-2:0], 1'b0} : largest;
    end
  end

  // Second stage: centred. Third: once or three times. Fourth: shifted and clamped.
  logic                  thrice_2;
  logic [3:0]            shift_2, shift_3;
  logic [VALUE_BITS-1:0] bound_2, bound_3, least_3;  // M, -M
  logic [ODD_BITS-1:0]   limit_3;           // M >> k

  always_ff @(posedge clk) begin
    if (advance) begin
      thrice_2 <= thrice_1;
      shift_2 <= shift_1;
      shift_3 <= shift_2;
      bound_2 <= bound_1;
      bound_3 <= bound_2;
      least_3 <= -bound_2;
      limit_3 <= {{(ODD_BITS - VALUE_BITS) {1'b0}}, bound_2 >> shift_2};
    end
  end

  genvar i;
  generate
    for (i = 0; i < SAMPLES; i = i + 1) begin : gen_sample
      logic [SUM_BITS-1:0]   centred;
      logic [ODD_BITS-1:0]   centred_wide, twice, odd;
      logic [VALUE_BITS-1:0] product, nearest;
      logic [ODD_BITS:0]     below_limit, above_limit;  // (M >> k) - odd, odd + (M >> k)
      logic                  outside;

      assign centred_wide = {{2{centred[SUM_BITS-1]}}, centred};
      assign twice = {centred[SUM_BITS-1], centred, 1'b0} & {ODD_BITS{thrice_2}};
      assign product = odd[VALUE_BITS-1:0] << shift_3;  // the low bits, which serve within [-M, M]
      assign nearest = odd[ODD_BITS-1] ? least_3 : bound_3;
      assign below_limit = {1'b0, limit_3} - {odd[ODD_BITS-1], odd};
      assign above_limit = {1'b0, limit_3} + {odd[ODD_BITS-1], odd};
      assign outside = below_limit[ODD_BITS] || above_limit[ODD_BITS];

      always_ff @(posedge clk) begin
        if (advance) begin
          centred <= {1'b0, values_1[i*VALUE_BITS +: VALUE_BITS]} + offset_1;
          odd <= centred_wide + twice;
          residuals[i*VALUE_BITS +: VALUE_BITS] <= outside ? nearest : product;
        end
      end
    end
  endgenerate
endmodule

`default_nettype wire
