// Number and size of a motion tile (MOT-1).
//
// Combinational. `second`: of motion plane number 4.
module hmlfc_motion_tile (
    input hmlfc_pkg::config_t stream,
    input logic second,
    input logic [9:0] tile_x,
    input logic [9:0] tile_y,
    input logic [hmlfc_pkg::TILE_BITS-1:0] first_tile,  // of the image
    output logic [hmlfc_pkg::TILE_BITS-1:0] tile,
    output logic [15:0] info  // {height, width} in samples, each at most 128
);
  localparam int TILE_BITS = hmlfc_pkg::TILE_BITS;
  hmlfc_pkg::motion_plane_t plane;
  assign plane = second ? stream.motion_chroma : stream.motion_luma;

  wire [2:0] log2 = stream.motion_tile_log2;
  wire [14:0] side = 15'd1 << log2;
  wire [14:0] width = plane.width - (15'(tile_x) << log2);
  wire [14:0] height = plane.height - (15'(tile_y) << log2);
  assign info[7:0] = width > side ? side[7:0] : width[7:0];
  assign info[15:8] = height > side ? side[7:0] : height[7:0];
  assign tile = first_tile + TILE_BITS'(plane.first_tile) + TILE_BITS'(20'(tile_y) * 20'(plane.tiles_x)) + TILE_BITS'(tile_x);
endmodule
