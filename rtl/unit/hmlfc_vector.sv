// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The displacement of a block in a reference image, from a disparity or an explicit vector
// (MOT-8, MOT-9).
//
// disparity                 d, [-4096, 4095]
// coefficient_x             ck - c, [-511, 511]
// coefficient_y             row_scale * (rk - r), [-131071, 131071]
// vector_precision          [0, 3]
// disparity_precision       [vector_precision, 5]; does not matter with explicit_mode
// window                    W, [0, 127]
// explicit_mode             choice 11: the vector is (explicit_x, explicit_y)
// explicit_x, explicit_y    [-2048, 2047], in vector units
// halve                     Co or Cg in format 4:2:0 with motion plane 3
// ix, iy                    whole samples, [-127, 127]
// fx, fy                    eighths of a sample beyond them, [0, 7]
//
// Latency 6 clocks with advance, one vector a clock: what is multiplied; then hmlfc_vector_axis.
module hmlfc_vector (
    input logic clk,
    input logic advance,
    input logic [12:0] disparity,
    input logic [9:0] coefficient_x,
    input logic [17:0] coefficient_y,
    input logic [1:0] vector_precision,
    input logic [2:0] disparity_precision,
    input logic [6:0] window,
    input logic explicit_mode,
    input logic [11:0] explicit_x,
    input logic [11:0] explicit_y,
    input logic halve,
    output logic [8:0] ix,
    output logic [8:0] iy,
    output logic [2:0] fx,
    output logic [2:0] fy
);
  logic [3:0] s;  // of MOT-8
  assign s = {1'b0, disparity_precision} - {2'd0, vector_precision};

  // An explicit vector is its product with 1, not shifted.
  logic [12:0] factor;
  logic [11:0] scale_x;
  logic [17:0] scale_y;
  logic [3:0]  shift_x, shift_y;
  logic [1:0]  precision;
  logic [6:0]  range;  // W
  logic        halved;
  always_ff @(posedge clk) begin
    if (advance) begin
      factor <= explicit_mode ? 13'd1 : disparity;
      scale_x <= explicit_mode ? explicit_x : {{2{coefficient_x[9]}}, coefficient_x};
      scale_y <= explicit_mode ? {{6{explicit_y[11]}}, explicit_y} : coefficient_y;
      shift_x <= explicit_mode ? 4'd0 : s;
      shift_y <= explicit_mode ? 4'd0 : s + 4'd4;
      precision <= vector_precision;
      range <= window;
      halved <= halve;
    end
  end

  hmlfc_vector_axis #(.COEFFICIENT_BITS(12)) axis_x (
    .clk(clk), .advance(advance), .disparity(factor), .coefficient(scale_x), .shift(shift_x),
    .vector_precision(precision), .window(range), .halve(halved), .eighths({ix, fx})
  );
  hmlfc_vector_axis #(.COEFFICIENT_BITS(18)) axis_y (
    .clk(clk), .advance(advance), .disparity(factor), .coefficient(scale_y), .shift(shift_y),
    .vector_precision(precision), .window(range), .halve(halved), .eighths({iy, fy})
  );
endmodule

`default_nettype wire
