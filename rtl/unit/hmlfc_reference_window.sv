// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Which samples of a reference plane a block needs (DEC-5, MOT-9), in two pipeline stages.
//
// A window of B + 1 by B + 1 samples from (x, y) on, each coordinate clamped to the plane; without
// `extra_x` (`extra_y`) the last column (row) has weight 0 and is not touched. The touched samples lie in
// at most 2 x 2 blocks: those of columns block_x and, with `two_x`, block_x + 1; rows likewise.
// Sample (i, j) of the window is the one in column select_x[i], row select_y[j] of these blocks.
// Latency 2 clocks with advance.
module hmlfc_reference_window #(
    parameter int BLOCK_LOG2 = 2,
    localparam int SIDE = (1 << BLOCK_LOG2) + 1,
    localparam int SELECT_BITS = BLOCK_LOG2 + 1,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS
) (
    input logic clk,
    input logic advance,
    input logic signed [16:0] x,
    input logic signed [16:0] y,
    input logic extra_x,
    input logic extra_y,
    input logic [14:0] width,
    input logic [14:0] height,
    output logic [BLOCK_BITS-1:0] block_x,
    output logic [BLOCK_BITS-1:0] block_y,
    output logic two_x,
    output logic two_y,
    output logic [SIDE*SELECT_BITS-1:0] select_x,
    output logic [SIDE*SELECT_BITS-1:0] select_y
);

  hmlfc_window_axis #(.BLOCK_LOG2(BLOCK_LOG2)) columns (
      .clk, .advance, .at(x), .size(width), .extra(extra_x), .block(block_x), .two(two_x), .select(select_x)
  );
  hmlfc_window_axis #(.BLOCK_LOG2(BLOCK_LOG2)) rows (
      .clk, .advance, .at(y), .size(height), .extra(extra_y), .block(block_y), .two(two_y), .select(select_y)
  );

endmodule

`default_nettype wire
