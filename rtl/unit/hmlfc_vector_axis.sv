// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// One coordinate of a displacement: rounded, clamped and in eighths of a sample (MOT-8, MOT-9).
//
// COEFFICIENT_BITS   >= 2
//
// disparity          d, [-4096, 4095]; 1 where the coefficient is the vector itself
// coefficient        in two's complement
// shift              k of rshift(d * coefficient, k), [0, 9]; |d * coefficient| < 2^29
// vector_precision   [0, 3]
// window             W, [0, 127]
// halve              u of MOT-9 is halved: Co or Cg in format 4:2:0 with motion plane 3
// eighths            [-1016, 1016]
//
// Latency 5 clocks with advance, one vector a clock: products with the parts of d = 512 d3 + 64 d2 + 8 d1 + d0; their
// sum; shift; clamp; eighths. rshift(x, k) is x >> k plus bit k - 1 of x, or plus 0 for k = 0.
module hmlfc_vector_axis #(
    parameter int COEFFICIENT_BITS = 18
) (
    input logic clk,
    input logic advance,
    input logic [12:0] disparity,
    input logic [COEFFICIENT_BITS-1:0] coefficient,
    input logic [3:0] shift,
    input logic [1:0] vector_precision,
    input logic [6:0] window,
    input logic halve,
    output logic [11:0] eighths
);
  localparam integer PART_BITS = COEFFICIENT_BITS + 4;
  localparam integer PRODUCT_BITS = 31;  // d * coefficient, with its sign twice

  logic signed [3:0]                  d0, d1, d2, d3;
  logic signed [COEFFICIENT_BITS-1:0] scale;
  assign d0 = {1'b0, disparity[2:0]};
  assign d1 = {1'b0, disparity[5:3]};
  assign d2 = {1'b0, disparity[8:6]};
  assign d3 = disparity[12:9];
  assign scale = coefficient;

  // What goes along with the vector.
  logic [3:0]  shift_1, shift_2;
  logic [10:0] bound_1, bound_2, bound_3, least_3;  // V; -V
  logic [1:0]  precision_1, precision_2, precision_3, precision_4;
  logic        halve_1, halve_2, halve_3, halve_4;
  always_ff @(posedge clk) begin
    if (advance) begin
      shift_1 <= shift;
      shift_2 <= shift_1;
      bound_1 <= {4'd0, window} << vector_precision;
      {bound_3, bound_2} <= {bound_2, bound_1};
      least_3 <= -bound_2;
      precision_1 <= vector_precision;
      {precision_4, precision_3, precision_2} <= {precision_3, precision_2, precision_1};
      halve_1 <= halve;
      {halve_4, halve_3, halve_2} <= {halve_3, halve_2, halve_1};
    end
  end

  // First stage: products. Second: their sum. Third: the shift; the bit below rounds.
  logic signed [PART_BITS-1:0]    part0, part1, part2, part3;
  logic signed [PRODUCT_BITS-1:0] sum, whole;
  logic                           round;
  always_ff @(posedge clk) begin
    if (advance) begin
      part0 <= d0 * scale;
      part1 <= d1 * scale;
      part2 <= d2 * scale;
      part3 <= d3 * scale;
      sum <= PRODUCT_BITS'(part0) + (PRODUCT_BITS'(part1) <<< 3) + (PRODUCT_BITS'(part2) <<< 6)
           + (PRODUCT_BITS'(part3) <<< 9);
      {whole, round} <= $signed({sum, 1'b0}) >>> shift_2;
    end
  end

  // Fourth stage: rounded and moved to [-V, V]. `round` enters each sum as the carry of a bit below. A number of more
  // than 12 bits lies outside.
  logic [12:0] rounded;
  logic [13:0] below_greatest, above_least;  // V less it, it plus V
  logic        outside;
  logic [10:0] v;
  assign rounded = {whole[11:0], round} + 13'd1;
  assign below_greatest = {2'd0, bound_3, 1'b1} + {~whole[11], ~whole[11:0], !round};
  assign above_least = {2'd0, bound_3, 1'b1} + {whole[11], whole[11:0], round};
  assign outside = PRODUCT_BITS'($signed(whole[11:0])) != whole || below_greatest[13] || above_least[13];
  always_ff @(posedge clk) begin
    if (advance) v <= !outside ? rounded[11:1] : whole[PRODUCT_BITS-1] ? least_3 : bound_3;
  end

  // Fifth stage: u of MOT-9, with one more bit for its rounding.
  logic [11:0] u, u_up;
  assign u = {v[10], v} << (2'd3 - precision_4);
  assign u_up = u + 12'd1;
  always_ff @(posedge clk) begin
    if (advance) eighths <= halve_4 ? {u_up[11], u_up[11:1]} : u;
  end
endmodule

`default_nettype wire
