// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Sizes of a plane in blocks, tiles and strips, and of a motion plane of the same samples (STR-6, MOT-1).
//
// Latency 1 clock. `first_tile` of both is 0; width and height are at least 1 and at most 16384. The motion plane has a
// meaning when motion_tile_log2 is 5, 6 or 7.
module hmlfc_plane_size #(
    parameter int BLOCK_LOG2 = 2
) (
    input logic clk,
    input logic [14:0] width,
    input logic [14:0] height,
    input logic [2:0] motion_tile_log2,
    output hmlfc_pkg::plane_t plane,
    output logic [10:0] tiles_y,
    output hmlfc_pkg::motion_plane_t motion_plane,
    output logic [9:0] motion_tiles_y
);
  localparam int LINES_LOG2 = 6 - 2 * BLOCK_LOG2;  // blocks of a strip

  // ceil(samples / 2^log2)
  function automatic logic [14:0] ceiling(input logic [14:0] samples, input int log2);
    ceiling = (samples + 15'((1 << log2) - 1)) >> log2;
  endfunction
  function automatic logic [9:0] motion_tiles(input logic [14:0] samples, input logic [2:0] log2);
    motion_tiles = log2 == 3'd5 ? 10'(ceiling(samples, 5)) : log2 == 3'd6 ? 10'(ceiling(samples, 6)) :
        10'(ceiling(samples, 7));
  endfunction

  always_ff @(posedge clk) begin
    plane.width <= width;
    plane.height <= height;
    plane.blocks_x <= 14'(ceiling(width, BLOCK_LOG2));
    plane.blocks_y <= 14'(ceiling(height, BLOCK_LOG2));
    plane.tiles_x <= 11'(ceiling(width, BLOCK_LOG2 + 3));
    plane.strips_x <= 11'(ceiling(width, BLOCK_LOG2 + LINES_LOG2));
    plane.first_tile <= '0;
    tiles_y <= 11'(ceiling(height, BLOCK_LOG2 + 3));
    motion_plane.width <= width;
    motion_plane.height <= height;
    motion_plane.tiles_x <= motion_tiles(width, motion_tile_log2);
    motion_plane.first_tile <= '0;
    motion_tiles_y <= motion_tiles(height, motion_tile_log2);
  end
endmodule

`default_nettype wire
