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

  function automatic logic [14:0] clamped(input logic signed [16:0] at, input logic [14:0] size);
    clamped = at < 0 ? '0 : at[15:0] >= {1'b0, size} ? size - 15'd1 : at[14:0];
  endfunction

  // 1: coordinates. The last one touched is that before it where its weight is 0.
  logic [SIDE*15-1:0] columns, rows;
  always_ff @(posedge clk) begin
    if (advance) begin
      for (int i = 0; i < SIDE; i++) begin
        columns[i*15+:15] <= clamped(x + 17'((i == SIDE - 1 && !extra_x) ? i - 1 : i), width);
        rows[i*15+:15] <= clamped(y + 17'((i == SIDE - 1 && !extra_y) ? i - 1 : i), height);
      end
    end
  end

  // 2: blocks, and places in them.
  wire [BLOCK_BITS-1:0] first_x = BLOCK_BITS'(columns[14:0] >> BLOCK_LOG2);
  wire [BLOCK_BITS-1:0] first_y = BLOCK_BITS'(rows[14:0] >> BLOCK_LOG2);
  always_ff @(posedge clk) begin
    if (advance) begin
      block_x <= first_x;
      block_y <= first_y;
      two_x <= BLOCK_BITS'(columns[(SIDE-1)*15+:15] >> BLOCK_LOG2) != first_x;
      two_y <= BLOCK_BITS'(rows[(SIDE-1)*15+:15] >> BLOCK_LOG2) != first_y;
      for (int i = 0; i < SIDE; i++) begin
        select_x[i*SELECT_BITS+:SELECT_BITS] <= {
          BLOCK_BITS'(columns[i*15+:15] >> BLOCK_LOG2) != first_x, columns[i*15+:BLOCK_LOG2]
        };
        select_y[i*SELECT_BITS+:SELECT_BITS] <= {
          BLOCK_BITS'(rows[i*15+:15] >> BLOCK_LOG2) != first_y, rows[i*15+:BLOCK_LOG2]
        };
      end
    end
  end

endmodule

`default_nettype wire
