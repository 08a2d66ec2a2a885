// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The table of images: of each of the views that are held, one image a level. Entry {view, level}.
//
// Written by hmlfc_view; each stage reads what it needs of an entry, combinational, from a memory of its own.
module hmlfc_images #(
    parameter int TRACE = 1,  // 0..1: rows and columns of images are kept
    localparam int ID_BITS = hmlfc_pkg::VIEW_BITS + 3,
    localparam int ENTRIES = 1 << ID_BITS
) (
    input logic clk,
    input logic write,
    input logic [ID_BITS-1:0] write_id,
    input hmlfc_pkg::image_t write_image,
    input logic [ID_BITS-1:0] tiles_id,
    output hmlfc_pkg::image_tiles_t tiles,
    input logic [ID_BITS-1:0] disparity_id,
    output logic [hmlfc_pkg::TILE_BITS-1:0] disparity_tile,
    input logic [ID_BITS-1:0] references_id,
    output hmlfc_pkg::image_references_t references,
    input logic [ID_BITS-1:0] place_id,
    output logic [2*hmlfc_pkg::GRID_BITS-1:0] place  // row, column; 0 without TRACE
);
  logic [hmlfc_pkg::IMAGE_TILES_BITS-1:0] all_tiles[ENTRIES];
  logic [hmlfc_pkg::TILE_BITS-1:0] all_disparity_tiles[ENTRIES];
  logic [hmlfc_pkg::IMAGE_REFERENCES_BITS-1:0] all_references[ENTRIES];
  always_ff @(posedge clk) begin
    if (write) begin
      all_tiles[write_id] <= write_image.tiles;
      all_disparity_tiles[write_id] <= write_image.disparity_tile;
      all_references[write_id] <= write_image.references;
    end
  end
  assign tiles = all_tiles[tiles_id];
  assign disparity_tile = all_disparity_tiles[disparity_id];
  assign references = all_references[references_id];

  if (TRACE != 0) begin : g_place
    logic [2*hmlfc_pkg::GRID_BITS-1:0] places[ENTRIES];
    always_ff @(posedge clk) if (write) places[write_id] <= {write_image.row, write_image.col};
    assign place = places[place_id];
  end else begin : g_no_place
    assign place = '0;
  end
endmodule

`default_nettype wire
