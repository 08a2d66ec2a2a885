// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The places in memory of the blocks of a rectangle, in the order in which hmlfc_view_scan asks for them.
//
// `start` takes `view`, which must hold until `done`; places come about 10 clocks later, then one a clock. What is left
// of an earlier scan is dropped by `start`. `done`: every place has been taken.
//
// An address is destination + (by - first_y) * B * pitch + (bx - first_x) * B * (bytes of a pixel). The first product
// is the start of the macro row, which a macro row adds to, and 5 bits of by times the bytes of a row of blocks.
module hmlfc_view_place #(
    parameter int BLOCK_LOG2 = 2,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS,
    localparam int TILE_BITS = BLOCK_BITS - 3
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input hmlfc_pkg::view_t view,
    output logic done,

    output logic place_valid,
    input logic place_ready,
    output hmlfc_pkg::place_t place
);

  // ---- The start: destination less the rows above it in its macro row. `weight` ends as the bytes of a macro row.
  localparam int ROW_BITS = 24 + BLOCK_LOG2;  // bytes of a row of blocks
  logic starting;
  logic [2:0] step;
  logic [ROW_BITS+4:0] weight;
  logic [4:0] above;
  logic scan_start, scan_valid, scan_block, scan_tile_ends, scan_macro_ends;
  logic [BLOCK_BITS-1:0] bx, by;
  logic go;
  assign scan_start = starting && step == 3'd5;
  hmlfc_view_scan scan (
      .clk, .rst_n(rst_n && !start), .start(scan_start), .blocks(view.blocks), .valid(scan_valid), .advance(go),
      .has_block(scan_block), .bx, .by, .tile_ends(scan_tile_ends), .macro_ends(scan_macro_ends)
  );

  // Tiles of the rectangle: tiles_x in a row; the number of the first of the macro row, modulo 2^22.
  wire [TILE_BITS-1:0] tiles_x = view.blocks.last_x[BLOCK_BITS-1:3] - view.blocks.first_x[BLOCK_BITS-1:3] + 1'b1;
  wire [TILE_BITS-1:0] tile_x = bx[BLOCK_BITS-1:3] - view.blocks.first_x[BLOCK_BITS-1:3];
  function automatic logic [21:0] tile_rows(input logic [1:0] rows, input logic [TILE_BITS-1:0] tiles);
    tile_rows = (rows[0] ? 22'(tiles) : 22'd0) + (rows[1] ? {11'd0, tiles, 1'b0} : 22'd0);
  endfunction
  logic [ADDRESS_BITS-1:0] macro_address;
  logic [21:0] macro_tile;

  always_ff @(posedge clk) begin
    if (start) begin
      step <= '0;
      weight <= {5'd0, view.pitch, BLOCK_LOG2'(0)};
      above <= view.blocks.first_y[4:0];
      macro_address <= view.destination;
      macro_tile <= 22'd0 - tile_rows(view.blocks.first_y[4:3], tiles_x);
    end else if (starting && !scan_start) begin
      step <= step + 3'd1;
      weight <= weight << 1;
      above <= above >> 1;
      if (above[0]) macro_address <= macro_address - ADDRESS_BITS'(weight);
    end else if (scan_valid && go && scan_macro_ends) begin
      macro_address <= macro_address + ADDRESS_BITS'(weight);
      macro_tile <= macro_tile + {10'd0, tiles_x, 2'd0};
    end
    if (!rst_n) starting <= 1'b0;
    else starting <= start || (starting && !scan_start);
  end

  // ---- Three clocks to an address.
  wire [ROW_BITS-1:0] row_bytes = weight[ROW_BITS+4:5];
  logic [3:1] valid;
  hmlfc_pkg::place_t place_1, place_2;
  logic [ADDRESS_BITS-1:0] base_1, base_2, rows_2;
  logic [BLOCK_BITS-1:0] from_left_1;
  logic [ROW_BITS+1:0] rows_low_1;
  logic [ROW_BITS+3:0] rows_middle_1;
  logic [ROW_BITS+3:0] rows_high_1;
  logic [BLOCK_BITS+2:0] units_2;  // bytes of the blocks to the left, in units of B
  assign go = !valid[3] || place_ready;
  assign place_valid = valid[3];
  assign done = !start && !starting && !scan_valid && valid == 0;

  always_ff @(posedge clk) begin
    if (go) begin
      // 1: parts of the product, by pairs of bits of by.
      place_1.has_block <= scan_block;
      place_1.tile_ends <= scan_tile_ends;
      place_1.tile_x <= bx[2:0];
      place_1.tile_y <= by[2:0];
      place_1.tile <= macro_tile + tile_rows(by[4:3], tiles_x) + 22'(tile_x);
      place_1.end_column <= bx == view.blocks.last_x ? view.end_column : 3'((1 << BLOCK_LOG2) - 1);
      place_1.end_row <= by == view.blocks.last_y ? view.end_row : 3'((1 << BLOCK_LOG2) - 1);
      place_1.address <= '0;
      base_1 <= macro_address;
      from_left_1 <= bx - view.blocks.first_x;
      rows_low_1 <= (by[0] ? {2'd0, row_bytes} : '0) + (by[1] ? {1'b0, row_bytes, 1'b0} : '0);
      rows_middle_1 <= {(by[2] ? {2'd0, row_bytes} : (ROW_BITS + 2)'(0)) +
          (by[3] ? {1'b0, row_bytes, 1'b0} : (ROW_BITS + 2)'(0)), 2'd0};
      rows_high_1 <= by[4] ? {row_bytes, 4'd0} : '0;
      // 2: bytes of the rows above, and to the left.
      place_2 <= place_1;
      base_2 <= base_1 + ADDRESS_BITS'(rows_high_1);
      rows_2 <= ADDRESS_BITS'(rows_middle_1) + ADDRESS_BITS'(rows_low_1);
      unique case (view.format)
        hmlfc_pkg::FORMAT_RGB888: units_2 <= {2'd0, from_left_1, 1'b0} + {3'd0, from_left_1};
        hmlfc_pkg::FORMAT_RGB101010: units_2 <= {1'b0, from_left_1, 2'd0};
        hmlfc_pkg::FORMAT_RGB161616: units_2 <= {1'b0, from_left_1, 2'd0} + {2'd0, from_left_1, 1'b0};
        default: units_2 <= {2'd0, from_left_1, 1'b0};
      endcase
      // 3: the address.
      place <= place_2;
      place.address <= base_2 + rows_2 + ADDRESS_BITS'({units_2, BLOCK_LOG2'(0)});
    end
    if (!rst_n || start) valid <= '0;
    else if (go) valid <= {valid[2:1], scan_valid};
  end

endmodule

`default_nettype wire
