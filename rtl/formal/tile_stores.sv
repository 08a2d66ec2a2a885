// From a block to its records each output of a stage reaches the inputs that it is for, in the same clock, and clients of the read master are the residual
// store's, the motion store's and that of disparities, in this order; whatever the stages put out.
//
// Clauses: none: tile stores (docs/pipeline.md)
// Engine: bmc 1
// Cut: tile_ask fifo motion_store disparity_ask disparity_store residual_store
// Complete: it has no logic of its own.
// Fault: hmlfc_tile_stores.sv / .out_data({disparity_in_flow, disparity_x, disparity_y}) / .out_data({disparity_in_flow, disparity_y, disparity_x})
// Fault: hmlfc_tile_stores.sv / .in_flow(disparity_flow) / .in_flow(disparity_in_flow)
// Fault: hmlfc_tile_stores.sv / .data_valid(data_valid[MOTION_CLIENT+:OTHER_LOADERS]) / .data_valid(data_valid[0+:OTHER_LOADERS])
// Fault: hmlfc_tile_stores.sv / disparity_id = motion_flow.job.id / disparity_id = shared_flow.job.id
`include "inside.svh"
module prove_tile_stores #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 12,
  parameter integer DATA_BITS = 64,
  parameter integer TILE_CONTEXTS = 2,
  parameter integer RESIDUAL_LOADERS = 4,
  parameter integer OTHER_LOADERS = 2,
  localparam integer N = RESIDUAL_LOADERS + 2 * OTHER_LOADERS
) (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic flush, input logic in_valid,
  input logic [hmlfc_pkg::JOB_BITS-1:0] in_job, input logic [hmlfc_pkg::IMAGE_TILES_BITS-1:0] in_image, input logic [43:0] disparity_first_tile,
  input logic out_ready, input logic [N-1:0] request_ready, input logic [N-1:0] data_valid, input logic [DATA_BITS-1:0] data, input logic data_last,
  input logic data_error
);
  localparam integer J = hmlfc_pkg::JOB_BITS, F = hmlfc_pkg::FLOW_BITS, I = hmlfc_pkg::IMAGE_TILES_BITS, T = hmlfc_pkg::TILE_BITS;
  localparam integer O = OTHER_LOADERS, M = RESIDUAL_LOADERS, D = M + O;  // of motion, of disparities: how many, the first client
  localparam integer C = $clog2(TILE_CONTEXTS), V = (MAX_DEPTH + 2) << (2 * BLOCK_LOG2);
  logic         in_ready, out_valid, out_has_residual;
  logic [hmlfc_pkg::VIEW_BITS+2:0] disparity_id;
  logic [F-1:0] out_flow;
  logic [V-1:0] out_residual;
  logic [N-1:0] request_valid;
  logic [N*40-1:0] request_address;
  logic [N*10-1:0] request_beats;
  hmlfc_tile_stores #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .DATA_BITS(DATA_BITS), .TILE_CONTEXTS(TILE_CONTEXTS), .RESIDUAL_LOADERS(RESIDUAL_LOADERS), .OTHER_LOADERS(OTHER_LOADERS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .in_valid(in_valid), .in_ready(in_ready), .in_job(in_job), .in_image(in_image),
    .disparity_id(disparity_id), .disparity_first_tile(disparity_first_tile), .out_valid(out_valid), .out_ready(out_ready), .out_flow(out_flow),
    .out_has_residual(out_has_residual), .out_residual(out_residual), .request_valid(request_valid), .request_ready(request_ready),
    .request_address(request_address), .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last),
    .data_error(data_error));
  `PORT(1, rst_n, \dut.tile_ask.rst_n )
  `PORT(751, stream_bits, \dut.tile_ask.stream )
  `PORT(I, in_image, \dut.tile_ask.image )
  `PORT(1, in_valid, \dut.tile_ask.in_valid )
  `PORT(1, in_ready, \dut.tile_ask.in_ready )
  `PORT(J, in_job, \dut.tile_ask.in_job )
  `LINK(1, \dut.tile_ask.residual_ask , \dut.residuals.ask )
  `LINK(T, \dut.tile_ask.residual_tile , \dut.residuals.ask_tile )
  `LINK(9, \dut.tile_ask.residual_info , \dut.residuals.ask_info )
  `LINK(1, \dut.tile_ask.residual_granted , \dut.residuals.granted )
  `LINK(C, \dut.tile_ask.residual_context , \dut.residuals.granted_context )
  `LINK(1, \dut.tile_ask.motion_ask , \dut.motions.ask )
  `LINK(T, \dut.tile_ask.motion_tile , \dut.motions.ask_tile )
  `LINK(17, \dut.tile_ask.motion_info , \dut.motions.ask_info )
  `LINK(1, \dut.tile_ask.motion_granted , \dut.motions.granted )
  `LINK(2, \dut.tile_ask.motion_context , \dut.motions.granted_context )
  `LINK(1, \dut.tile_ask.out_valid , \dut.before_motion.in_valid )
  `LINK(1, \dut.tile_ask.out_ready , \dut.before_motion.in_ready )
  `LINK(F, \dut.tile_ask.out_flow , \dut.before_motion.in_data )
  `PORT(1, rst_n, \dut.before_motion.rst_n )
  `LINK(1, \dut.before_motion.out_valid , \dut.motions.in_valid )
  `LINK(1, \dut.before_motion.out_ready , \dut.motions.in_ready )
  `LINK(F, \dut.before_motion.out_data , \dut.motions.in_flow )
  `PORT(1, rst_n, \dut.motions.rst_n )
  `PORT(751, stream_bits, \dut.motions.stream )
  `PORT(1, flush, \dut.motions.flush )
  `LINK(1, \dut.motions.out_valid , \dut.disparity_asking.in_valid )
  `LINK(1, \dut.motions.out_ready , \dut.disparity_asking.in_ready )
  `LINK(F, \dut.motions.out_flow , \dut.disparity_asking.in_flow )
  hmlfc_pkg::flow_t motion_flow;
  assign motion_flow = \dut.motions.out_flow ;
  always @* assert (disparity_id == motion_flow.job.id);
  `PORT(1, rst_n, \dut.disparity_asking.rst_n )
  `PORT(751, stream_bits, \dut.disparity_asking.stream )
  `PORT(T, disparity_first_tile, \dut.disparity_asking.first_tile )
  `LINK(1, \dut.disparity_asking.ask , \dut.disparities.ask )
  `LINK(T, \dut.disparity_asking.ask_tile , \dut.disparities.ask_tile )
  `LINK(16, \dut.disparity_asking.ask_info , \dut.disparities.ask_info )
  `LINK(1, \dut.disparity_asking.granted , \dut.disparities.granted )
  `LINK(2, \dut.disparity_asking.granted_context , \dut.disparities.granted_context )
  `LINK(1, \dut.disparity_asking.out_valid , \dut.before_disparity.in_valid )
  `LINK(1, \dut.disparity_asking.out_ready , \dut.before_disparity.in_ready )
  // The block, then its place: x, y.
  (* hierconn *) wire [F+9:0] \dut.before_disparity.in_data ;
  (* hierconn *) wire [F+9:0] \dut.before_disparity.out_data ;
  `PORT(F, \dut.before_disparity.in_data [F+9:10], \dut.disparity_asking.out_flow )
  `PORT(5, \dut.before_disparity.in_data [9:5], \dut.disparity_asking.out_x )
  `PORT(5, \dut.before_disparity.in_data [4:0], \dut.disparity_asking.out_y )
  `PORT(F, \dut.before_disparity.out_data [F+9:10], \dut.disparities.in_flow )
  `PORT(5, \dut.before_disparity.out_data [9:5], \dut.disparities.in_x )
  `PORT(5, \dut.before_disparity.out_data [4:0], \dut.disparities.in_y )
  `PORT(1, rst_n, \dut.before_disparity.rst_n )
  `LINK(1, \dut.before_disparity.out_valid , \dut.disparities.in_valid )
  `LINK(1, \dut.before_disparity.out_ready , \dut.disparities.in_ready )
  `PORT(1, rst_n, \dut.disparities.rst_n )
  `PORT(751, stream_bits, \dut.disparities.stream )
  `PORT(1, flush, \dut.disparities.flush )
  `LINK(1, \dut.disparities.out_valid , \dut.residuals.in_valid )
  `LINK(1, \dut.disparities.out_ready , \dut.residuals.in_ready )
  `LINK(F, \dut.disparities.out_flow , \dut.residuals.in_flow )
  `PORT(1, rst_n, \dut.residuals.rst_n )
  `PORT(751, stream_bits, \dut.residuals.stream )
  `PORT(1, flush, \dut.residuals.flush )
  `PORT(1, out_valid, \dut.residuals.out_valid )
  `PORT(1, out_ready, \dut.residuals.out_ready )
  `PORT(F, out_flow, \dut.residuals.out_flow )
  `PORT(1, out_has_residual, \dut.residuals.out_has_residual )
  `PORT(V, out_residual, \dut.residuals.out_residual )
  // Clients of the read master.
  `PORT(M, request_valid[0 +: M], \dut.residuals.request_valid )
  `PORT(M, request_ready[0 +: M], \dut.residuals.request_ready )
  `PORT(M*40, request_address[0 +: M*40], \dut.residuals.request_address )
  `PORT(M*10, request_beats[0 +: M*10], \dut.residuals.request_beats )
  `PORT(M, data_valid[0 +: M], \dut.residuals.data_valid )
  `PORT(O, request_valid[M +: O], \dut.motions.request_valid )
  `PORT(O, request_ready[M +: O], \dut.motions.request_ready )
  `PORT(O*40, request_address[M*40 +: O*40], \dut.motions.request_address )
  `PORT(O*10, request_beats[M*10 +: O*10], \dut.motions.request_beats )
  `PORT(O, data_valid[M +: O], \dut.motions.data_valid )
  `PORT(O, request_valid[D +: O], \dut.disparities.request_valid )
  `PORT(O, request_ready[D +: O], \dut.disparities.request_ready )
  `PORT(O*40, request_address[D*40 +: O*40], \dut.disparities.request_address )
  `PORT(O*10, request_beats[D*10 +: O*10], \dut.disparities.request_beats )
  `PORT(O, data_valid[D +: O], \dut.disparities.data_valid )
  `PORT(DATA_BITS, data, \dut.residuals.data )
  `PORT(DATA_BITS, data, \dut.motions.data )
  `PORT(DATA_BITS, data, \dut.disparities.data )
  `PORT(1, data_last, \dut.residuals.data_last )
  `PORT(1, data_last, \dut.motions.data_last )
  `PORT(1, data_last, \dut.disparities.data_last )
  `PORT(1, data_error, \dut.residuals.data_error )
  `PORT(1, data_error, \dut.motions.data_error )
  `PORT(1, data_error, \dut.disparities.data_error )
endmodule
