// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The blocks of a rectangle in scan order: macro rows of 32 rows of blocks; in them squares of 16 x 16 blocks column by
// column, top square first; in a square its tiles row by row; in a tile its quads row by row; in a quad its blocks row
// by row.
//
// `start` takes `blocks`, which must hold until the scan has ended. From the next clock on `valid` offers a position,
// one a clock: `has_block` says whether the rectangle has it. Squares, tiles, rows of quads and quads of which it has
// none are passed in one clock. `tile_ends`: it is the last position offered of a tile of which the rectangle has
// blocks; `macro_ends`: the next one is in the next macro row.
module hmlfc_view_scan #(
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input hmlfc_pkg::rectangle_t blocks,

    output logic valid,
    input logic advance,
    output logic has_block,
    output logic [BLOCK_BITS-1:0] bx,
    output logic [BLOCK_BITS-1:0] by,
    output logic tile_ends,
    output logic macro_ends
);

  // A position: macro row, column of squares, and in the two squares of a column: square, tile, quad, block.
  logic [BLOCK_BITS-6:0] macro_row;
  logic [BLOCK_BITS-5:0] column;
  logic [8:0] place;
  assign bx = {column, place[6], place[3:2], place[0]};
  assign by = {macro_row, place[8:7], place[5:4], place[1]};

  // Whether the rectangle has blocks of the square, the tile, the row of quads, the quad. Columns outside it are not
  // visited.
  wire square = by[BLOCK_BITS-1:4] >= blocks.first_y[BLOCK_BITS-1:4] &&
      by[BLOCK_BITS-1:4] <= blocks.last_y[BLOCK_BITS-1:4];
  wire tile = by[BLOCK_BITS-1:3] >= blocks.first_y[BLOCK_BITS-1:3] &&
      by[BLOCK_BITS-1:3] <= blocks.last_y[BLOCK_BITS-1:3] &&
      bx[BLOCK_BITS-1:3] >= blocks.first_x[BLOCK_BITS-1:3] && bx[BLOCK_BITS-1:3] <= blocks.last_x[BLOCK_BITS-1:3];
  wire quads = by[BLOCK_BITS-1:1] >= blocks.first_y[BLOCK_BITS-1:1] &&
      by[BLOCK_BITS-1:1] <= blocks.last_y[BLOCK_BITS-1:1];
  wire quad = quads && bx[BLOCK_BITS-1:1] >= blocks.first_x[BLOCK_BITS-1:1] &&
      bx[BLOCK_BITS-1:1] <= blocks.last_x[BLOCK_BITS-1:1];
  assign has_block = by >= blocks.first_y && by <= blocks.last_y && bx >= blocks.first_x && bx <= blocks.last_x;

  // What is passed begins here: its lower bits are 0.
  wire [9:0] next = {1'b0, place} + (!square ? 10'd256 : !tile ? 10'd64 : !quads ? 10'd16 : !quad ? 10'd4 :
      10'd1);
  wire last_column = column == blocks.last_x[BLOCK_BITS-1:4];
  assign tile_ends = tile && (quad ? &place[5:0] : quads ? &place[5:2] : &place[5:4]);
  assign macro_ends = next[9] && last_column;

  always_ff @(posedge clk) begin
    if (!rst_n) valid <= 1'b0;
    else if (start) valid <= 1'b1;
    else if (advance && macro_ends && macro_row == blocks.last_y[BLOCK_BITS-1:5]) valid <= 1'b0;
    if (start) begin
      macro_row <= blocks.first_y[BLOCK_BITS-1:5];
      column <= blocks.first_x[BLOCK_BITS-1:4];
      place <= '0;
    end else if (valid && advance) begin
      place <= next[8:0];
      if (next[9]) column <= last_column ? blocks.first_x[BLOCK_BITS-1:4] : column + 1'b1;
      if (macro_ends) macro_row <= macro_row + 1'b1;
    end
  end

endmodule

`default_nettype wire
