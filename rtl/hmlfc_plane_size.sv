// Sizes of a plane in blocks, tiles and strips, and of a motion plane of the same samples (STR-6, MOT-1).
//
// Combinational. `first_tile` of both is 0; width and height are at least 1 and at most 16384.
module hmlfc_plane_size #(
    parameter int BLOCK_LOG2 = 2
) (
    input logic [14:0] width,
    input logic [14:0] height,
    input logic [2:0] motion_tile_log2,
    output hmlfc_pkg::plane_t plane,
    output logic [21:0] tiles,
    output logic [31:0] strips,
    output hmlfc_pkg::motion_plane_t motion_plane,
    output logic [21:0] motion_tiles
);
  localparam int LINES_LOG2 = 6 - 2 * BLOCK_LOG2;  // blocks of a strip
  localparam int LINES_MASK = (1 << LINES_LOG2) - 1;
  localparam int BLOCK_MASK = (1 << BLOCK_LOG2) - 1;

  wire [13:0] blocks_x = 14'((width + 15'(BLOCK_MASK)) >> BLOCK_LOG2);
  wire [13:0] blocks_y = 14'((height + 15'(BLOCK_MASK)) >> BLOCK_LOG2);
  wire [10:0] tiles_x = 11'((blocks_x + 14'd7) >> 3);
  wire [10:0] tiles_y = 11'((blocks_y + 14'd7) >> 3);
  wire [10:0] strips_x = 11'((blocks_x + 14'(LINES_MASK)) >> LINES_LOG2);
  wire [14:0] motion_mask = ~(15'h7FFF << motion_tile_log2);
  wire [9:0] motion_x = 10'((width + motion_mask) >> motion_tile_log2);
  wire [9:0] motion_y = 10'((height + motion_mask) >> motion_tile_log2);

  always_comb begin
    plane.width = width;
    plane.height = height;
    plane.blocks_x = blocks_x;
    plane.blocks_y = blocks_y;
    plane.tiles_x = tiles_x;
    plane.strips_x = strips_x;
    plane.first_tile = '0;
    motion_plane.width = width;
    motion_plane.height = height;
    motion_plane.tiles_x = motion_x;
    motion_plane.first_tile = '0;
  end
  assign tiles = 22'(tiles_x) * 22'(tiles_y);
  assign strips = 32'(strips_x) * 32'(blocks_y);
  assign motion_tiles = 22'(motion_x) * 22'(motion_y);
endmodule
