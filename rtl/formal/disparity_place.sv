// Four clocks after a block with choice 1 to 9, the tile and the place in it of the grid block that the choice names,
// the block's own or a neighbour of it within the grid; the tile's number and size are those of hmlfc_motion_tile
// (proof motion_tile). Blocks within their plane. BLOCK_LOG2 = 2. Without stalls, which only delay.
//
// Clauses: MOT-4, MOT-5, MOT-6
// Engine: bmc 5
// Still: hmlfc_disparity_place advance
// Complete: four stages without feedback.
module prove_disparity_place #(
  parameter integer BLOCK_LOG2 = 2
) (
  input logic clk, input logic advance, input logic [hmlfc_pkg::FLOW_BITS-1:0] flow_bits,
      input logic [hmlfc_pkg::TILE_BITS-1:0] first_tile
);
  localparam integer T = hmlfc_pkg::TILE_BITS;
  (* anyconst *) hmlfc_pkg::config_t stream;
  hmlfc_pkg::flow_t flow;
  assign flow = flow_bits;
  logic [T-1:0] tile;
  logic [15:0]  info;
  logic [4:0]   x, y;
  hmlfc_disparity_place #(.BLOCK_LOG2(BLOCK_LOG2)) dut (
    .clk(clk), .advance(advance), .stream(stream), .flow(flow_bits), .first_tile(first_tile), .tile(tile), .info(info),
    .x(x), .y(y));

  // MOT-4: the block's place in its motion plane, number 4 for chroma with chroma_motion.
  wire        chroma = flow.job.plane != 0;
  wire        second = chroma && stream.features.chroma_motion;
  wire        doubled = chroma && !second && !stream.chroma_444;
  wire [15:0] place_x = 16'(flow.job.bx) << (BLOCK_LOG2 + doubled);
  wire [15:0] place_y = 16'(flow.job.by) << (BLOCK_LOG2 + doubled);
  wire [15:0] width = second ? stream.motion_chroma.width : stream.motion_luma.width;
  wire [15:0] height = second ? stream.motion_chroma.height : stream.motion_luma.height;

  // MOT-5 and MOT-6: the grid block, of sides of 2^grid samples.
  wire [2:0]  grid = stream.disparity_grid_log2;
  wire [3:0]  choice = flow.motion.choice;
  function automatic signed [17:0] moved(input [15:0] place, input [15:0] size, input [2:0] log2,
      input signed [17:0] step);
    integer to, count;
    count = (size + (1 << log2) - 1) >> log2;
    to = place >> log2;
    to = to + step;
    moved = to < 0 ? 0 : to >= count ? count - 1 : to;
  endfunction
  logic signed [17:0] step_x, step_y;
  always @* begin
    step_x = 0;
    step_y = 0;
    case (choice)
      4'd2: step_x = -1;
      4'd3: step_x = 1;
      4'd4: step_y = -1;
      4'd5: step_y = 1;
      4'd6: {step_x, step_y} = {-18'sd1, -18'sd1};
      4'd7: {step_x, step_y} = {18'sd1, -18'sd1};
      4'd8: {step_x, step_y} = {-18'sd1, 18'sd1};
      4'd9: {step_x, step_y} = {18'sd1, 18'sd1};
      default: ;
    endcase
  end
  wire [17:0] grid_x = moved(place_x, width, grid, step_x);
  wire [17:0] grid_y = moved(place_y, height, grid, step_y);
  wire [2:0]  tile_log2 = stream.motion_tile_log2 - grid;
  wire [17:0] tile_x = grid_x >> tile_log2;
  wire [17:0] tile_y = grid_y >> tile_log2;

  // What is expected two clocks later; the tile's number and size, from there on.
  logic [3:0] filled = 4'd0;
  logic [30:0] which_1, which_2;  // {second, tile_y, tile_x, y, x}
  logic [9:0]  at_3, at_4;
  logic [T-1:0] first_1, first_2;
  (* hierconn *) wire [9:0] \dut.tile_x_2 ;
  (* hierconn *) wire [9:0] \dut.tile_y_2 ;
  (* hierconn *) wire \dut.second_2 ;
  (* hierconn *) wire [T-1:0] \dut.first_2 ;
  logic [T-1:0] expected_tile;
  logic [15:0]  expected_info;
  hmlfc_motion_tile motion (
    .clk(clk), .advance(advance), .stream(stream), .second(\dut.second_2 ), .tile_x(\dut.tile_x_2 ),
    .tile_y(\dut.tile_y_2 ), .first_tile(\dut.first_2 ), .tile(expected_tile), .info(expected_info));
  always @(posedge clk) begin
    filled <= {filled[2:0], 1'b1};
    which_1 <= {second, tile_y[9:0], tile_x[9:0], 5'(grid_y - (tile_y << tile_log2)),
        5'(grid_x - (tile_x << tile_log2))};
    first_1 <= first_tile;
    {which_2, first_2} <= {which_1, first_1};
    {at_4, at_3} <= {at_3, which_2[9:0]};
  end
  always @* begin
    assume (advance);
    assume (flow.job.plane != 3 && choice >= 1 && choice <= 9 && width >= 1 && width <= 16384 && height >= 1 &&
        height <= 16384);
    assume (place_x < width && place_y < height);
    assume (stream.motion_tile_log2 >= 5 && stream.motion_tile_log2 <= 7 && grid >= 2 && grid <= 5);
    if (filled == 4'b0011)
      assert ({\dut.second_2 , \dut.tile_y_2 , \dut.tile_x_2 , \dut.first_2 } == {which_2[30:10], first_2});
    if (filled[3]) assert ({tile, info, y, x} == {expected_tile, expected_info, at_4});
  end
endmodule
