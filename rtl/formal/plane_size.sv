// A clock after width and height in [1, 16384] the numbers of blocks, tiles and strips of a plane and of motion tiles
// are their quotients, rounded up. BLOCK_LOG2 = 2.
//
// Clauses: STR-6, MOT-1
// Engine: bmc 3
// Complete: one stage.
module prove_plane_size #(
  parameter integer BLOCK_LOG2 = 2
) (
  input logic clk, input logic [14:0] in_width, input logic [14:0] in_height, input logic [2:0] in_log2
);
  hmlfc_pkg::plane_t plane;
  hmlfc_pkg::motion_plane_t motion_plane;
  // What is legal.
  wire [14:0] width = in_width == 0 ? 15'd1 : in_width > 16384 ? 15'd16384 : in_width;
  wire [14:0] height = in_height == 0 ? 15'd1 : in_height > 16384 ? 15'd16384 : in_height;
  wire [2:0]  log2 = in_log2 < 5 || in_log2 > 7 ? 3'd5 : in_log2;
  logic [101:0] plane_bits;
  logic [61:0] motion_bits;
  assign plane = plane_bits;
  assign motion_plane = motion_bits;
  logic [10:0] tiles_y;
  logic [9:0]  motion_tiles_y;
  hmlfc_plane_size #(.BLOCK_LOG2(BLOCK_LOG2)) dut (
    .clk(clk), .width(width), .height(height), .motion_tile_log2(log2), .plane(plane_bits), .tiles_y(tiles_y),
    .motion_plane(motion_bits), .motion_tiles_y(motion_tiles_y));

  logic [14:0] w, h;
  logic [2:0]  l;
  logic        filled = 1'b0;
  always @(posedge clk) {filled, w, h, l} <= {1'b1, width, height, log2};
  // Blocks of the sides of a tile: 8; of a strip, 16 samples wide with 2 x 2 blocks, 4 with 4 x 4 and 8 with 8 x 8
  // (STR-6).
  function automatic integer quotient(input [14:0] samples, input integer side);
    quotient = (samples + side - 1) / side;
  endfunction
  localparam integer B = 1 << BLOCK_LOG2;
  localparam integer STRIP = B * (64 / (B * B));
  always @* if (filled) begin
    assert (plane.width == w && plane.height == h && plane.first_tile == 0);
    assert (plane.blocks_x == quotient(w, B) && plane.blocks_y == quotient(h, B));
    assert (plane.tiles_x == quotient(w, 8 * B) && tiles_y == quotient(h, 8 * B));
    assert (plane.strips_x == quotient(w, STRIP));
    assert (motion_plane.width == w && motion_plane.height == h && motion_plane.first_tile == 0);
    assert (motion_plane.tiles_x == (l == 5 ? quotient(w, 32) : l == 6 ? quotient(w, 64) : quotient(w, 128)));
    assert (motion_tiles_y == (l == 5 ? quotient(h, 32) : l == 6 ? quotient(h, 64) : quotient(h, 128)));
  end
endmodule
