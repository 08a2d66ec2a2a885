// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Number of a tile (IDX-2), two clocks later, one a clock: first_tile + plane_first + tile_y * tiles_x + tile_x.
module hmlfc_tile_number #(
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS
) (
    input logic clk,
    input logic advance,
    input logic [TILE_BITS-1:0] first_tile,  // of the image
    input logic [21:0] plane_first,  // of the plane among the tiles of an image
    input logic [10:0] tiles_x,
    input logic [10:0] tile_x,
    input logic [10:0] tile_y,
    output logic [TILE_BITS-1:0] tile
);
  logic [TILE_BITS-1:0] first_1;
  logic [21:0] in_image_1;
  always_ff @(posedge clk) begin
    if (advance) begin
      // 1: number in the image.
      in_image_1 <= 22'(tile_y) * 22'(tiles_x) + plane_first + 22'(tile_x);
      first_1 <= first_tile;
      // 2: number in the stream.
      tile <= first_1 + TILE_BITS'(in_image_1);
    end
  end
endmodule

`default_nettype wire
