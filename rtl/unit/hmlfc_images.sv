// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The table of images: of each of the views that are held, one image a level. An id is {view, level}; the table has
// room for all views with four levels (`shallow`), or for half of them with eight.
//
// Written by hmlfc_view; each stage reads what it needs of an entry from a memory of its own: references in the clock
// after `references_read`, until the next; the others, combinational.
module hmlfc_images #(
    parameter int TRACE = 1,  // 0..1: rows and columns of images are kept
    localparam int ID_BITS = hmlfc_pkg::VIEW_BITS + 3,
    localparam int ENTRIES = 1 << (ID_BITS - 1)
) (
    input logic clk,
    input logic shallow,
    input logic write,
    input logic [ID_BITS-1:0] write_id,
    input hmlfc_pkg::image_t write_image,
    input logic [ID_BITS-1:0] tiles_id,
    output hmlfc_pkg::image_tiles_t tiles,
    input logic [ID_BITS-1:0] disparity_id,
    output logic [hmlfc_pkg::TILE_BITS-1:0] disparity_tile,
    input logic references_read,
    input logic [ID_BITS-1:0] references_id,
    output hmlfc_pkg::image_references_t references,
    input logic [ID_BITS-1:0] place_id,
    output logic [2*hmlfc_pkg::GRID_BITS-1:0] place  // row, column; 0 without TRACE
);
  function automatic logic [ID_BITS-2:0] entry_of(input logic [ID_BITS-1:0] id, input logic of_four);
    entry_of = {of_four ? id[ID_BITS-1] : id[2], id[ID_BITS-2:3], id[1:0]};
  endfunction
  wire [ID_BITS-2:0] write_entry = entry_of(write_id, shallow);

  logic [hmlfc_pkg::IMAGE_TILES_BITS-1:0] all_tiles[ENTRIES];
  logic [hmlfc_pkg::TILE_BITS-1:0] all_disparity_tiles[ENTRIES];
  always_ff @(posedge clk) begin
    if (write) begin
      all_tiles[write_entry] <= write_image.tiles;
      all_disparity_tiles[write_entry] <= write_image.disparity_tile;
    end
  end
  assign tiles = all_tiles[entry_of(tiles_id, shallow)];
  assign disparity_tile = all_disparity_tiles[entry_of(disparity_id, shallow)];
  hmlfc_ram #(.WIDTH(hmlfc_pkg::IMAGE_REFERENCES_BITS), .DEPTH(ENTRIES)) all_references (
      .clk, .write, .write_address(write_entry), .write_data(write_image.references), .read(references_read),
      .read_address(entry_of(references_id, shallow)), .read_data(references)
  );

  if (TRACE != 0) begin : g_place
    logic [2*hmlfc_pkg::GRID_BITS-1:0] places[ENTRIES];
    always_ff @(posedge clk) if (write) places[write_entry] <= {write_image.row, write_image.col};
    assign place = places[entry_of(place_id, shallow)];
  end else begin : g_no_place
    assign place = '0;
  end
endmodule

`default_nettype wire
