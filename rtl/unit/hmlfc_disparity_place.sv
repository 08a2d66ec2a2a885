// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Where the disparity of a block stands (MOT-5, MOT-6), four clocks later, one a clock: the tile, and the grid block in
// it.
//
// For choices 1 to 9; the motion plane is that of the same number of K0.
module hmlfc_disparity_place #(
    parameter int BLOCK_LOG2 = 2
) (
    input logic clk,
    input logic advance,
    input hmlfc_pkg::config_t stream,
    input hmlfc_pkg::flow_t flow,
    input logic [hmlfc_pkg::TILE_BITS-1:0] first_tile,  // of K0
    output logic [hmlfc_pkg::TILE_BITS-1:0] tile,
    output logic [15:0] info,  // {height, width} of the tile in samples
    output logic [4:0] x,
    output logic [4:0] y
);
  localparam int TILE_BITS = hmlfc_pkg::TILE_BITS;
  wire [2:0] grid = stream.disparity_grid_log2;

  // 1: the block's own grid block, the plane's last ones, and which neighbour it is.
  logic [14:0] place_x, place_y;
  hmlfc_motion_place #(.BLOCK_LOG2(BLOCK_LOG2)) place (
      .stream, .plane(flow.job.plane), .bx(flow.job.bx), .by(flow.job.by), .x(place_x), .y(place_y)
  );
  wire second = stream.features.chroma_motion && flow.job.plane != 2'd0;
  hmlfc_pkg::motion_plane_t plane;
  assign plane = second ? stream.motion_chroma : stream.motion_luma;
  wire [3:0] choice = flow.motion.choice;
  logic [14:0] own_x, own_y, last_x, last_y;
  logic left, right, above, below;
  always_ff @(posedge clk) begin
    if (advance) begin
      own_x <= place_x >> grid;
      own_y <= place_y >> grid;
      last_x <= (plane.width - 15'd1) >> grid;
      last_y <= (plane.height - 15'd1) >> grid;
      left <= choice == 4'd2 || choice == 4'd6 || choice == 4'd8;
      right <= choice == 4'd3 || choice == 4'd7 || choice == 4'd9;
      above <= choice == 4'd4 || choice == 4'd6 || choice == 4'd7;
      below <= choice == 4'd5 || choice == 4'd8 || choice == 4'd9;
    end
  end

  // 2: the grid block, within the plane; its tile, and its place there.
  logic [14:0] grid_x, grid_y;
  always_comb begin
    grid_x = own_x;
    if (left && own_x != 0) grid_x = own_x - 15'd1;
    if (right) grid_x = own_x + 15'd1;
    if (grid_x > last_x) grid_x = last_x;
    grid_y = own_y;
    if (above && own_y != 0) grid_y = own_y - 15'd1;
    if (below) grid_y = own_y + 15'd1;
    if (grid_y > last_y) grid_y = last_y;
  end

  wire [2:0] tile_log2 = stream.motion_tile_log2 - grid;  // in grid blocks
  wire [4:0] mask = ~(5'h1F << tile_log2);
  logic [9:0] tile_x_2, tile_y_2, at_2, at_3;  // at: {y, x}
  logic second_1, second_2;
  logic [TILE_BITS-1:0] first_1, first_2;
  always_ff @(posedge clk) begin
    if (advance) begin
      tile_x_2 <= 10'(grid_x >> tile_log2);
      tile_y_2 <= 10'(grid_y >> tile_log2);
      at_2 <= {grid_y[4:0] & mask, grid_x[4:0] & mask};
      {second_1, second_2} <= {second, second_1};
      {first_1, first_2} <= {first_tile, first_1};
    end
  end

  // 3 and 4: the tile's number and size.
  hmlfc_motion_tile area (
      .clk, .advance, .stream, .second(second_2), .tile_x(tile_x_2), .tile_y(tile_y_2), .first_tile(first_2), .tile,
      .info
  );
  always_ff @(posedge clk) if (advance) {at_3, y, x} <= {at_2, at_3};

endmodule

`default_nettype wire
