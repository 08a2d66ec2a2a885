// Two clocks after its inputs, with any stalls, the number of a motion tile is that of the image's first tile, plus
// that of the plane, plus its own in the plane; its sides are those of a tile, or what the plane has left. Tiles within
// the plane.
//
// Clauses: MOT-1, IDX-2
// Engine: bmc 6
// Complete: two stages without feedback.
module prove_motion_tile (
  input logic clk, input logic advance, input logic second, input logic [9:0] tile_x, input logic [9:0] tile_y,
  input logic [hmlfc_pkg::TILE_BITS-1:0] first_tile
);
  localparam integer T = hmlfc_pkg::TILE_BITS;
  (* anyconst *) logic [14:0] width_luma;
  (* anyconst *) logic [14:0] height_luma;
  (* anyconst *) logic [9:0] across_luma;
  (* anyconst *) logic [21:0] first_luma;
  (* anyconst *) logic [14:0] width_chroma;
  (* anyconst *) logic [14:0] height_chroma;
  (* anyconst *) logic [9:0] across_chroma;
  (* anyconst *) logic [21:0] first_chroma;
  (* anyconst *) logic [2:0] log2;
  hmlfc_pkg::config_t stream;
  always @* begin
    stream = '0;
    stream.motion_tile_log2 = log2;
    stream.motion_luma = {width_luma, height_luma, across_luma, first_luma};
    stream.motion_chroma = {width_chroma, height_chroma, across_chroma, first_chroma};
  end
  logic [T-1:0] tile;
  logic [15:0]  info;
  hmlfc_motion_tile dut (
    .clk(clk), .advance(advance), .stream(stream), .second(second), .tile_x(tile_x), .tile_y(tile_y),
    .first_tile(first_tile), .tile(tile), .info(info));

  wire [14:0] width = second ? width_chroma : width_luma;
  wire [14:0] height = second ? height_chroma : height_luma;
  wire [9:0]  across = second ? across_chroma : across_luma;
  wire [21:0] first = second ? first_chroma : first_luma;
  wire [16:0] side = 17'd1 << log2;
  wire [17:0] left_x = {3'd0, width} - ({8'd0, tile_x} << log2);
  wire [17:0] left_y = {3'd0, height} - ({8'd0, tile_y} << log2);
  wire [21:0] in_image = 22'(tile_y) * 22'(across) + 22'(tile_x) + first;
  logic [1:0] filled = 2'd0;
  logic [T+15:0] expected_1, expected_2;
  always @(posedge clk) begin
    if (advance) begin
      filled <= {filled[0], 1'b1};
      expected_1 <= {first_tile + T'(in_image), left_y < side ? left_y[7:0] : side[7:0], left_x < side ? left_x[7:0] :
          side[7:0]};
      expected_2 <= expected_1;
    end
  end
  always @* begin
    assume (log2 >= 5 && log2 <= 7 && width <= 16384 && height <= 16384);
    assume ({8'd0, tile_x} << log2 < width && {8'd0, tile_y} << log2 < height);
    if (filled[1]) assert ({tile, info} == expected_2);
  end
endmodule
