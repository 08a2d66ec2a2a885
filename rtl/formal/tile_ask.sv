// Each block leaves once, in order, with any stalls, when both stores have a place for the tiles that it needs, and asks each for its own then: with the
// tile's number and size (STR-6; proofs tile_number, motion_tile) at the block's place (MOT-4; hmlfc_motion_place). Key images and blocks with an error
// need none, others a residual tile and, with motion tiles but in reference images, a motion tile. Residuals of an image that has none, or is
// no reference image, get bad_request. BLOCK_LOG2 = 2, 2 and 4 contexts. The first 6 clocks.
//
// Clauses: IDX-2, MOT-1, MOT-2, MOT-4
// Engine: bmc 6
// Complete: three stages without feedback; blocks within their plane.
// Fault: hmlfc_tile_ask.sv / in_job.plane == 2'd2 ? stream.first_tile_cg / in_job.plane == 2'd1 ? stream.first_tile_cg
// Fault: hmlfc_tile_ask.sv / rows_1 > 14'd8 / rows_1 > 14'd9
// Fault: hmlfc_tile_ask.sv / (!needs_motion || motion_granted) / 1'b1
// Fault: hmlfc_tile_ask.sv / !(image.keyed && image.is_reference) / !image.keyed
`include "hmlfc_tables.svh"

module prove_tile_ask #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer RESIDUAL_CONTEXTS = 2,
  parameter integer MOTION_CONTEXTS = 4
) (
  input logic clk, input logic [hmlfc_pkg::IMAGE_TILES_BITS-1:0] image_bits, input logic in_valid, input logic [hmlfc_pkg::JOB_BITS-1:0] in_job,
  input logic residual_granted, input logic motion_granted, input logic out_ready
);
  localparam integer T = hmlfc_pkg::TILE_BITS;
  localparam integer J = hmlfc_pkg::JOB_BITS;
  (* anyseq *) logic [$clog2(RESIDUAL_CONTEXTS)-1:0] residual_context;
  (* anyseq *) logic [$clog2(MOTION_CONTEXTS)-1:0] motion_context;
  (* anyconst *) logic [750:0] stream_bits;
  hmlfc_pkg::config_t stream;
  hmlfc_pkg::image_tiles_t image;
  hmlfc_pkg::job_t job;
  hmlfc_pkg::flow_t flow;
  assign stream = stream_bits;
  assign image = image_bits;
  assign job = in_job;
  logic         started = 1'b0;
  logic         in_ready, residual_ask, motion_ask, out_valid;
  logic [T-1:0] residual_tile, motion_tile;
  logic [8:0]   residual_info;
  logic [16:0]  motion_info;
  logic [hmlfc_pkg::FLOW_BITS-1:0] out_flow;
  assign flow = out_flow;
  hmlfc_tile_ask #(.BLOCK_LOG2(BLOCK_LOG2), .RESIDUAL_CONTEXTS(RESIDUAL_CONTEXTS), .MOTION_CONTEXTS(MOTION_CONTEXTS)) dut (
    .clk(clk), .rst_n(started), .stream(stream_bits), .image(image_bits), .in_valid(in_valid), .in_ready(in_ready), .in_job(in_job),
    .residual_ask(residual_ask), .residual_tile(residual_tile), .residual_info(residual_info), .residual_granted(residual_granted),
    .residual_context(residual_context), .motion_ask(motion_ask), .motion_tile(motion_tile), .motion_info(motion_info),
    .motion_granted(motion_granted), .motion_context(motion_context), .out_valid(out_valid), .out_ready(out_ready), .out_flow(out_flow));

  // Its residual tile: number, rows and columns of blocks.
  wire         chroma = job.plane != 0;
  wire [10:0]  across = chroma ? stream.chroma.tiles_x : stream.luma.tiles_x;
  wire [13:0]  blocks_x = chroma ? stream.chroma.blocks_x : stream.luma.blocks_x;
  wire [13:0]  blocks_y = chroma ? stream.chroma.blocks_y : stream.luma.blocks_y;
  wire [21:0]  first = job.plane == 0 ? stream.luma.first_tile : job.plane == 1 ? stream.chroma.first_tile : stream.first_tile_cg;
  wire [10:0]  tile_x = job.bx / 8;
  wire [10:0]  tile_y = job.by / 8;
  wire [13:0]  left_x = blocks_x - 14'(tile_x) * 14'd8;
  wire [13:0]  left_y = blocks_y - 14'(tile_y) * 14'd8;
  // Its motion tile.
  logic [14:0] place_x, place_y;
  hmlfc_motion_place #(.BLOCK_LOG2(BLOCK_LOG2)) place (
    .stream(stream_bits), .plane(job.plane), .bx(job.bx), .by(job.by), .x(place_x), .y(place_y));
  // Which tiles, after a clock; their numbers and sizes two clocks later. Multipliers with the same inputs are one for the solver.
  (* hierconn *) wire \dut.advance ;
  (* hierconn *) wire [T-1:0] \dut.first_1 ;
  (* hierconn *) wire [21:0] \dut.plane_first_1 ;
  (* hierconn *) wire [10:0] \dut.tiles_x_1 ;
  (* hierconn *) wire [10:0] \dut.tile_x_1 ;
  (* hierconn *) wire [10:0] \dut.tile_y_1 ;
  (* hierconn *) wire \dut.second_1 ;
  (* hierconn *) wire [9:0] \dut.motion_x_1 ;
  (* hierconn *) wire [9:0] \dut.motion_y_1 ;
  localparam integer W = T + 22 + 33 + 21;
  logic [W-1:0] which;
  wire [W-1:0]  which_1 = {\dut.first_1 , \dut.plane_first_1 , \dut.tiles_x_1 , \dut.tile_x_1 , \dut.tile_y_1 , \dut.second_1 , \dut.motion_x_1 , \dut.motion_y_1 };
  logic [T-1:0] expected_residual, expected_motion;
  logic [15:0]  expected_size;
  hmlfc_tile_number number (
    .clk(clk), .advance(\dut.advance ), .first_tile(\dut.first_1 ), .plane_first(\dut.plane_first_1 ), .tiles_x(\dut.tiles_x_1 ),
    .tile_x(\dut.tile_x_1 ), .tile_y(\dut.tile_y_1 ), .tile(expected_residual));
  hmlfc_motion_tile motion (
    .clk(clk), .advance(\dut.advance ), .stream(stream_bits), .second(\dut.second_1 ), .tile_x(\dut.motion_x_1 ), .tile_y(\dut.motion_y_1 ),
    .first_tile(\dut.first_1 ), .tile(expected_motion), .info(expected_size));

  wire refused = job.residuals && (image.keyed || !image.is_reference);
  wire coded = job.error == 0 && !refused && !(image.keyed && image.is_reference);
  wire moves = coded && stream.features.motion_tiles && !image.is_reference;
  wire predictive = !stream.features.motion_tiles && !image.is_reference;
  localparam integer E = J + 4 + 8;
  logic [3:1]   valid;
  logic         filled = 1'b0;
  logic [E-1:0] entry_1, entry_2, entry_3;
  wire [J-1:0]  checked = {in_job[J-1:6], refused ? 6'(HMLFC_ERROR_BAD_REQUEST) : job.error};
  always @(posedge clk) begin
    started <= 1'b1;
    if (in_ready) begin
      filled <= started;
      entry_1 <= {checked, coded, moves, predictive, image.keyed, left_y < 8 ? left_y[3:0] : 4'd8, left_x < 8 ? left_x[3:0] : 4'd8};
      which <= {image.first_tile, first, across, tile_x, tile_y, chroma && stream.features.chroma_motion, 10'(place_x >> stream.motion_tile_log2),
                10'(place_y >> stream.motion_tile_log2)};
      {entry_3, entry_2} <= {entry_2, entry_1};
    end
    valid <= !started ? 3'd0 : in_ready ? {valid[2:1], in_valid} : valid;
  end
  wire [J-1:0] job_3 = entry_3[E-1 -: J];
  wire needs_residual = entry_3[11];
  wire needs_motion = entry_3[10];
  wire granted = (!needs_residual || residual_granted) && (!needs_motion || motion_granted);
  wire leaves = out_valid && out_ready;
  always @* if (started) begin
    assume (job.plane != 3 && job.bx < blocks_x && job.by < blocks_y && stream.motion_tile_log2 >= 5);
    assert (out_valid == (valid[3] && granted) && in_ready == (!valid[3] || leaves));
    assert (\dut.advance == in_ready);
    if (filled) assert (which_1 == which);
    assert (residual_ask == (leaves && needs_residual) && motion_ask == (leaves && needs_motion));
    if (residual_ask) assert (residual_tile == expected_residual && residual_info == {entry_3[9], entry_3[7:0]});
    if (motion_ask) assert (motion_tile == expected_motion && motion_info == {entry_3[8], expected_size});
    if (out_valid) begin
      assert (flow.job == job_3 && flow.residual_asked == needs_residual && flow.motion_asked == needs_motion);
      assert (flow.residual_context == residual_context && flow.motion_context == motion_context && !flow.disparity_asked);
    end
  end
endmodule
