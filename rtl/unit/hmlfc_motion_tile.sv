// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Number and size of a motion tile (MOT-1), two clocks later, one a clock.
//
// `second`: of motion plane number 4.
module hmlfc_motion_tile (
    input logic clk,
    input logic advance,
    input hmlfc_pkg::config_t stream,
    input logic second,
    input logic [9:0] tile_x,
    input logic [9:0] tile_y,
    input logic [hmlfc_pkg::TILE_BITS-1:0] first_tile,  // of the image
    output logic [hmlfc_pkg::TILE_BITS-1:0] tile,
    output logic [15:0] info  // {height, width} in samples, each at most 128
);
  hmlfc_pkg::motion_plane_t plane;
  assign plane = second ? stream.motion_chroma : stream.motion_luma;
  hmlfc_tile_number number (
      .clk, .advance, .first_tile, .plane_first(plane.first_tile), .tiles_x(11'(plane.tiles_x)), .tile_x(11'(tile_x)),
      .tile_y(11'(tile_y)), .tile
  );

  wire [2:0] log2 = stream.motion_tile_log2;
  wire [14:0] side = 15'd1 << log2;
  logic [14:0] width_1, height_1;
  always_ff @(posedge clk) begin
    if (advance) begin
      // 1: samples of the plane from the tile on; 2: of those, the tile's.
      width_1 <= plane.width - (15'(tile_x) << log2);
      height_1 <= plane.height - (15'(tile_y) << log2);
      info[7:0] <= width_1 > side ? side[7:0] : width_1[7:0];
      info[15:8] <= height_1 > side ? side[7:0] : height_1[7:0];
    end
  end
endmodule

`default_nettype wire
