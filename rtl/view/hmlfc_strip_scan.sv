// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The blocks of a plane in the order of strips, and the addresses of these (docs/decode_unit.md, "The reference area"):
// columns of 16 blocks, so that few tiles are in use at once; in a column rows of blocks, top to bottom; in a row
// blocks left to right.
//
// `start` takes `view`, which must hold until the scan has ended; its rectangle begins at block (0, 0). From the next
// clock on `valid` offers a block, one a clock, with the address of its strip; `strip_begins` and `strip_ends`: the
// first and the last one in its strip.
module hmlfc_strip_scan #(
    parameter int BLOCK_LOG2 = 2,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input hmlfc_pkg::view_t view,

    output logic valid,
    input logic advance,
    output logic [BLOCK_BITS-1:0] bx,
    output logic [BLOCK_BITS-1:0] by,
    output logic strip_begins,
    output logic strip_ends,
    output logic [ADDRESS_BITS-1:0] address
);

  localparam int BLOCKS = 64 >> (2 * BLOCK_LOG2);  // of a strip
  localparam logic [11:0] STRIP_BYTES = 12'd128;
  localparam logic [11:0] COLUMN_BYTES = 12'(16 / BLOCKS) * STRIP_BYTES;

  logic [ADDRESS_BITS-1:0] column_address, row_address;
  wire last_of_row = bx == view.blocks.last_x;
  wire row_ends = last_of_row || bx[3:0] == 4'd15;
  wire column_ends = row_ends && by == view.blocks.last_y;
  assign strip_begins = (bx[3:0] & 4'(BLOCKS - 1)) == 0;
  assign strip_ends = last_of_row || (bx[3:0] & 4'(BLOCKS - 1)) == 4'(BLOCKS - 1);

  always_ff @(posedge clk) begin
    if (!rst_n) valid <= 1'b0;
    else if (start) valid <= 1'b1;
    else if (advance && column_ends && last_of_row) valid <= 1'b0;
    if (start) begin
      bx <= '0;
      by <= '0;
      column_address <= view.destination;
      row_address <= view.destination;
      address <= view.destination;
    end else if (valid && advance) begin
      bx <= !row_ends || column_ends ? bx + 1'b1 : {bx[BLOCK_BITS-1:4], 4'd0};
      if (column_ends) begin
        by <= '0;
        column_address <= column_address + ADDRESS_BITS'(COLUMN_BYTES);
        row_address <= column_address + ADDRESS_BITS'(COLUMN_BYTES);
        address <= column_address + ADDRESS_BITS'(COLUMN_BYTES);
      end else if (row_ends) begin
        by <= by + 1'b1;
        row_address <= row_address + ADDRESS_BITS'(view.pitch);
        address <= row_address + ADDRESS_BITS'(view.pitch);
      end else if (strip_ends) begin
        address <= address + ADDRESS_BITS'(STRIP_BYTES);
      end
    end
  end

endmodule

`default_nettype wire
