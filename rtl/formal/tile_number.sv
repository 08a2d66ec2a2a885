// Two clocks after its inputs the number of a tile is first_tile + plane_first + tile_y * tiles_x + tile_x, with any
// stalls.
//
// Clauses: IDX-2
// Engine: bmc 6
// Complete: two stages without feedback; a product of 22 bits and a number of TILE_BITS bits.
module prove_tile_number (
  input logic clk, input logic advance, input logic [hmlfc_pkg::TILE_BITS-1:0] first_tile,
      input logic [21:0] plane_first,
  input logic [10:0] tiles_x, input logic [10:0] tile_x, input logic [10:0] tile_y
);
  localparam integer T = hmlfc_pkg::TILE_BITS;
  logic [T-1:0] tile;
  hmlfc_tile_number dut (
    .clk(clk), .advance(advance), .first_tile(first_tile), .plane_first(plane_first), .tiles_x(tiles_x),
    .tile_x(tile_x), .tile_y(tile_y), .tile(tile));
  logic [1:0]   filled = 2'd0;
  logic [T-1:0] number_1, number_2;
  wire [21:0]   in_image = 22'(tile_y) * 22'(tiles_x) + 22'(tile_x) + plane_first;
  always @(posedge clk) begin
    if (advance) begin
      filled <= {filled[0], 1'b1};
      number_1 <= first_tile + T'(in_image);
      number_2 <= number_1;
    end
  end
  always @* if (filled[1]) assert (tile == number_2);
endmodule
