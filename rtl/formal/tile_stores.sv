// In the tile stores each output of the requests for tiles, the queues between and the three stores reaches each input that it is for, in the same
// clock; whatever they put out. Blocks pass them in the order of the module's comment; loaders of residual tiles are the first clients of the read
// master, then those of motion tiles and of disparities. 64 bits; BLOCK_LOG2 = 2; 2 contexts; 4, 2 and 2 loaders.
//
// Clauses: none: tile stores (docs/pipeline.md)
// Engine: bmc 1
// Cut: tile_ask fifo motion_store disparity_ask disparity_store residual_store
// Complete: no logic of its own.
// Fault: hmlfc_tile_stores.sv / .in_y(disparity_y) / .in_y(disparity_x)
// Fault: hmlfc_tile_stores.sv / disparity_id = motion_flow / disparity_id = disparity_flow
// Fault: hmlfc_tile_stores.sv / .data_valid(data_valid[DISPARITY_CLIENT+: / .data_valid(data_valid[MOTION_CLIENT+:
`define LINK(width, a, b) (* hierconn *) wire [width-1:0] a , b ; always @* assert (a == b );
`define PORT(width, port, b) (* hierconn *) wire [width-1:0] b ; always @* assert (port == b );
module prove_tile_stores (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic flush, input logic in_valid,
  input logic [hmlfc_pkg::JOB_BITS-1:0] in_job, input logic [hmlfc_pkg::IMAGE_TILES_BITS-1:0] in_image, input logic [43:0] disparity_first_tile,
  input logic out_ready, input logic [7:0] request_ready, input logic [7:0] data_valid, input logic [63:0] data, input logic data_last,
  input logic data_error
);
  localparam integer F = hmlfc_pkg::FLOW_BITS;
  logic           in_ready, out_valid, out_has_residual;
  logic [6:0]     disparity_id;
  logic [F-1:0]   out_flow;
  logic [223:0]   out_residual;
  logic [7:0]     request_valid;
  logic [319:0]   request_address;
  logic [79:0]    request_beats;
  hmlfc_tile_stores #(.BLOCK_LOG2(2), .MAX_DEPTH(12), .DATA_BITS(64), .TILE_CONTEXTS(2), .RESIDUAL_LOADERS(4), .OTHER_LOADERS(2)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .in_valid(in_valid), .in_ready(in_ready), .in_job(in_job), .in_image(in_image),
    .disparity_id(disparity_id), .disparity_first_tile(disparity_first_tile), .out_valid(out_valid), .out_ready(out_ready), .out_flow(out_flow),
    .out_has_residual(out_has_residual), .out_residual(out_residual), .request_valid(request_valid), .request_ready(request_ready),
    .request_address(request_address), .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last),
    .data_error(data_error));

  // The way of a block.
  `PORT(1, in_valid, \dut.tile_ask.in_valid )
  `PORT(1, in_ready, \dut.tile_ask.in_ready )
  `PORT(hmlfc_pkg::JOB_BITS, in_job, \dut.tile_ask.in_job )
  `PORT(hmlfc_pkg::IMAGE_TILES_BITS, in_image, \dut.tile_ask.image )
  `LINK(1, \dut.tile_ask.out_valid , \dut.before_motion.in_valid )
  `LINK(1, \dut.tile_ask.out_ready , \dut.before_motion.in_ready )
  `LINK(1, \dut.before_motion.out_valid , \dut.motions.in_valid )
  `LINK(1, \dut.before_motion.out_ready , \dut.motions.in_ready )
  `LINK(1, \dut.motions.out_valid , \dut.disparity_asking.in_valid )
  `LINK(1, \dut.motions.out_ready , \dut.disparity_asking.in_ready )
  `LINK(1, \dut.disparity_asking.out_valid , \dut.before_disparity.in_valid )
  `LINK(1, \dut.disparity_asking.out_ready , \dut.before_disparity.in_ready )
  `LINK(1, \dut.before_disparity.out_valid , \dut.disparities.in_valid )
  `LINK(1, \dut.before_disparity.out_ready , \dut.disparities.in_ready )
  `LINK(1, \dut.disparities.out_valid , \dut.residuals.in_valid )
  `LINK(1, \dut.disparities.out_ready , \dut.residuals.in_ready )
  `LINK(F, \dut.tile_ask.out_flow , \dut.before_motion.in_data )
  `LINK(F, \dut.before_motion.out_data , \dut.motions.in_flow )
  `LINK(F, \dut.motions.out_flow , \dut.disparity_asking.in_flow )
  `LINK(F, \dut.disparities.out_flow , \dut.residuals.in_flow )
  (* hierconn *) wire [F-1:0] \dut.disparity_asking.out_flow , \dut.disparities.in_flow ;
  (* hierconn *) wire [4:0] \dut.disparity_asking.out_x , \dut.disparity_asking.out_y , \dut.disparities.in_x , \dut.disparities.in_y ;
  `PORT(F+10, {\dut.disparity_asking.out_flow , \dut.disparity_asking.out_x , \dut.disparity_asking.out_y }, \dut.before_disparity.in_data )
  `PORT(F+10, {\dut.disparities.in_flow , \dut.disparities.in_x , \dut.disparities.in_y }, \dut.before_disparity.out_data )
  hmlfc_pkg::job_t of_motion;
  assign of_motion = \dut.motions.out_flow [F-1 -: hmlfc_pkg::JOB_BITS];
  always @* assert (disparity_id == of_motion.id);
  `PORT(44, disparity_first_tile, \dut.disparity_asking.first_tile )
  `PORT(1, out_valid, \dut.residuals.out_valid )
  `PORT(1, out_ready, \dut.residuals.out_ready )
  `PORT(F, out_flow, \dut.residuals.out_flow )
  `PORT(1, out_has_residual, \dut.residuals.out_has_residual )
  `PORT(224, out_residual, \dut.residuals.out_residual )
  // Who asks for which tiles.
  `LINK(1, \dut.tile_ask.residual_ask , \dut.residuals.ask )
  `LINK(44, \dut.tile_ask.residual_tile , \dut.residuals.ask_tile )
  `LINK(9, \dut.tile_ask.residual_info , \dut.residuals.ask_info )
  `LINK(1, \dut.tile_ask.residual_granted , \dut.residuals.granted )
  `LINK(1, \dut.tile_ask.residual_context , \dut.residuals.granted_context )
  `LINK(1, \dut.tile_ask.motion_ask , \dut.motions.ask )
  `LINK(44, \dut.tile_ask.motion_tile , \dut.motions.ask_tile )
  `LINK(17, \dut.tile_ask.motion_info , \dut.motions.ask_info )
  `LINK(1, \dut.tile_ask.motion_granted , \dut.motions.granted )
  `LINK(2, \dut.tile_ask.motion_context , \dut.motions.granted_context )
  `LINK(1, \dut.disparity_asking.ask , \dut.disparities.ask )
  `LINK(44, \dut.disparity_asking.ask_tile , \dut.disparities.ask_tile )
  `LINK(16, \dut.disparity_asking.ask_info , \dut.disparities.ask_info )
  `LINK(1, \dut.disparity_asking.granted , \dut.disparities.granted )
  `LINK(2, \dut.disparity_asking.granted_context , \dut.disparities.granted_context )
  // Clients, and what goes to all.
  `PORT(4, request_valid[3:0], \dut.residuals.request_valid )
  `PORT(4, request_ready[3:0], \dut.residuals.request_ready )
  `PORT(160, request_address[159:0], \dut.residuals.request_address )
  `PORT(40, request_beats[39:0], \dut.residuals.request_beats )
  `PORT(4, data_valid[3:0], \dut.residuals.data_valid )
  `PORT(64, data, \dut.residuals.data )
  `PORT(1, data_last, \dut.residuals.data_last )
  `PORT(1, data_error, \dut.residuals.data_error )
  `PORT(1, flush, \dut.residuals.flush )
  `PORT(2, request_valid[5:4], \dut.motions.request_valid )
  `PORT(2, request_ready[5:4], \dut.motions.request_ready )
  `PORT(80, request_address[239:160], \dut.motions.request_address )
  `PORT(20, request_beats[59:40], \dut.motions.request_beats )
  `PORT(2, data_valid[5:4], \dut.motions.data_valid )
  `PORT(64, data, \dut.motions.data )
  `PORT(1, data_last, \dut.motions.data_last )
  `PORT(1, data_error, \dut.motions.data_error )
  `PORT(1, flush, \dut.motions.flush )
  `PORT(2, request_valid[7:6], \dut.disparities.request_valid )
  `PORT(2, request_ready[7:6], \dut.disparities.request_ready )
  `PORT(80, request_address[319:240], \dut.disparities.request_address )
  `PORT(20, request_beats[79:60], \dut.disparities.request_beats )
  `PORT(2, data_valid[7:6], \dut.disparities.data_valid )
  `PORT(64, data, \dut.disparities.data )
  `PORT(1, data_last, \dut.disparities.data_last )
  `PORT(1, data_error, \dut.disparities.data_error )
  `PORT(1, flush, \dut.disparities.flush )
  `PORT(1, rst_n, \dut.tile_ask.rst_n )
  `PORT(751, stream_bits, \dut.tile_ask.stream )
  `PORT(1, rst_n, \dut.motions.rst_n )
  `PORT(751, stream_bits, \dut.motions.stream )
  `PORT(1, rst_n, \dut.disparity_asking.rst_n )
  `PORT(751, stream_bits, \dut.disparity_asking.stream )
  `PORT(1, rst_n, \dut.disparities.rst_n )
  `PORT(751, stream_bits, \dut.disparities.stream )
  `PORT(1, rst_n, \dut.residuals.rst_n )
  `PORT(751, stream_bits, \dut.residuals.stream )
  `PORT(1, rst_n, \dut.before_motion.rst_n )
  `PORT(1, rst_n, \dut.before_disparity.rst_n )
endmodule
