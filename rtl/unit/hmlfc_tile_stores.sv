// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// From a block of a level to its records: motion, disparity, residual; at most one index walk for each (BND-2, BND-3).
//
//   tile_ask -> [128] -> motions -> disparity_ask -> [64] -> disparities -> residuals
//      |                  ^ asked for   |                     ^ asked for by  ^ asked for
//      +-- by tile_ask ---+             +---- disparity_ask --+               +-- by tile_ask
//
// Blocks keep their order; the queues hide the time in which requested tiles come from memory. Clients of the read
// master: those of hmlfc_tile_fetch.
module hmlfc_tile_stores #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int DATA_BITS = 128,
    parameter int TILE_CONTEXTS = 16,
    parameter int BLOCK_CLOCKS = 1,  // of a block with residuals
    localparam int READ_REQUEST_BITS = hmlfc_pkg::READ_REQUEST_BITS,
    localparam int READ_RESPONSE_BITS = hmlfc_pkg::READ_RESPONSE_BITS,
    localparam int RESIDUAL_BITS = (MAX_DEPTH + 2) << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::job_t in_job,
    input hmlfc_pkg::image_tiles_t in_image,  // of in_job.id

    output logic [hmlfc_pkg::VIEW_BITS+2:0] disparity_id,
    input logic [hmlfc_pkg::TILE_BITS-1:0] disparity_first_tile,  // of disparity_id

    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow,
    output logic out_has_residual,
    output logic [RESIDUAL_BITS-1:0] out_residual,

    output logic [2*READ_REQUEST_BITS-1:0] requests,
    input logic [2*READ_RESPONSE_BITS-1:0] responses,
    input logic [DATA_BITS-1:0] data
);

  localparam int FLOW_BITS = hmlfc_pkg::FLOW_BITS;
  localparam int MOTION_CONTEXTS = TILE_CONTEXTS < 4 ? TILE_CONTEXTS : 4;
  localparam int DISPARITY_CONTEXTS = MOTION_CONTEXTS;

  // Words of the longest record of a tile (section 11, bit position in a tile record), with a beat for its skew.
  localparam int RESIDUAL_WORDS = 1 << $clog2((64 * (RESIDUAL_BITS + 23) + 4096 + DATA_BITS + 63) / 64);
  localparam int MOTION_WORDS = 1 << $clog2((9 + 8 * 32 + 3 * 1024 + DATA_BITS + 63) / 64);
  localparam int DISPARITY_WORDS = 1 << $clog2((18 + 10 * 1024 + DATA_BITS + 63) / 64);
  localparam int RESIDUAL_LOG2 = $clog2(RESIDUAL_WORDS * 64 / DATA_BITS);  // of its beats
  localparam int MOTION_LOG2 = $clog2(MOTION_WORDS * 64 / DATA_BITS);
  localparam int DISPARITY_LOG2 = $clog2(DISPARITY_WORDS * 64 / DATA_BITS);

  // Stores 0 to 2 are those of residuals, motions and disparities.
  localparam int LOAD_BITS = 5 + hmlfc_pkg::TILE_INFO_BITS + hmlfc_pkg::TILE_BITS;
  localparam int PARSE_BITS = 5 + hmlfc_pkg::TILE_INFO_BITS + 7 + $clog2(DATA_BITS) + hmlfc_pkg::POSITION_BITS;
  logic [2:0] load_valid, load_ready, write, parse_valid, parse_ready;
  logic [3*LOAD_BITS-1:0] loads;
  logic [14:0] write_beat;
  logic [3*PARSE_BITS-1:0] parses;
  hmlfc_tile_fetch #(
      .DATA_BITS(DATA_BITS), .CONTEXTS_0(TILE_CONTEXTS), .CONTEXTS_1(MOTION_CONTEXTS), .CONTEXTS_2(DISPARITY_CONTEXTS),
      .BEATS_LOG2_0(RESIDUAL_LOG2), .BEATS_LOG2_1(MOTION_LOG2), .BEATS_LOG2_2(DISPARITY_LOG2)
  ) fetch (
      .clk, .rst_n, .stream, .flush, .load_valid, .load_ready, .loads, .write, .write_beat, .parse_valid, .parse_ready,
      .parses, .requests, .responses, .data
  );

  logic residual_ask, residual_granted, motion_ask, motion_granted, disparity_ask, disparity_granted;
  logic [hmlfc_pkg::TILE_BITS-1:0] residual_tile, motion_tile, disparity_tile;
  logic [8:0] residual_info;
  logic [16:0] motion_info;
  logic [15:0] disparity_info;
  logic [$clog2(TILE_CONTEXTS)-1:0] residual_context;
  logic [$clog2(MOTION_CONTEXTS)-1:0] motion_context;
  logic [$clog2(DISPARITY_CONTEXTS)-1:0] disparity_context;
  logic ask_valid, ask_ready, motion_in_valid, motion_in_ready, motion_valid, motion_ready;
  hmlfc_pkg::flow_t ask_flow, motion_in_flow, motion_flow;
  hmlfc_tile_ask #(
      .BLOCK_LOG2(BLOCK_LOG2), .RESIDUAL_CONTEXTS(TILE_CONTEXTS), .MOTION_CONTEXTS(MOTION_CONTEXTS)
  ) tile_ask (
      .clk, .rst_n, .stream, .image(in_image), .in_valid, .in_ready, .in_job, .residual_ask, .residual_tile,
      .residual_info, .residual_granted, .residual_context, .motion_ask, .motion_tile, .motion_info, .motion_granted,
      .motion_context, .out_valid(ask_valid), .out_ready(ask_ready), .out_flow(ask_flow)
  );
  hmlfc_fifo #(.WIDTH(FLOW_BITS), .DEPTH(128), .BYPASS(BLOCK_CLOCKS == 1)) before_motion (
      .clk, .rst_n, .in_valid(ask_valid), .in_ready(ask_ready), .in_data(ask_flow), .out_valid(motion_in_valid),
      .out_ready(motion_in_ready), .out_data(motion_in_flow), .count()
  );
  hmlfc_tile_store #(
      .KIND(hmlfc_pkg::MOTION_TILES), .BLOCK_LOG2(BLOCK_LOG2), .DATA_BITS(DATA_BITS), .CONTEXTS(MOTION_CONTEXTS),
      .CONTEXT_WORDS(MOTION_WORDS)
  ) motions (
      .clk, .rst_n, .stream, .flush, .ask(motion_ask), .ask_tile(motion_tile), .ask_info(motion_info),
      .granted(motion_granted), .granted_context(motion_context), .in_valid(motion_in_valid),
      .in_ready(motion_in_ready), .in_flow(motion_in_flow), .in_x('0), .in_y('0), .out_valid(motion_valid),
      .out_ready(motion_ready), .out_flow(motion_flow), .out_has_residual(), .out_residual(),
      .load_valid(load_valid[1]), .load_ready(load_ready[1]), .load(loads[1*LOAD_BITS+:LOAD_BITS]), .write(write[1]),
      .write_beat(write_beat[$clog2(MOTION_CONTEXTS)+MOTION_LOG2-1:0]), .data, .parse_valid(parse_valid[1]),
      .parse_ready(parse_ready[1]), .parse(parses[1*PARSE_BITS+:PARSE_BITS])
  );

  logic shared_valid, shared_ready, disparity_in_valid, disparity_in_ready, disparity_valid, disparity_ready;
  hmlfc_pkg::flow_t shared_flow, disparity_in_flow, disparity_flow;
  logic [4:0] shared_x, shared_y, disparity_x, disparity_y;
  assign disparity_id = motion_flow.job.id;
  hmlfc_disparity_ask #(.BLOCK_LOG2(BLOCK_LOG2), .CONTEXTS(DISPARITY_CONTEXTS)) disparity_asking (
      .clk, .rst_n, .stream, .first_tile(disparity_first_tile), .in_valid(motion_valid), .in_ready(motion_ready),
      .in_flow(motion_flow), .ask(disparity_ask), .ask_tile(disparity_tile), .ask_info(disparity_info),
      .granted(disparity_granted), .granted_context(disparity_context), .out_valid(shared_valid),
      .out_ready(shared_ready), .out_flow(shared_flow), .out_x(shared_x), .out_y(shared_y)
  );
  hmlfc_fifo #(.WIDTH(FLOW_BITS + 10), .DEPTH(64), .BYPASS(BLOCK_CLOCKS == 1)) before_disparity (
      .clk, .rst_n, .in_valid(shared_valid), .in_ready(shared_ready), .in_data({shared_flow, shared_x, shared_y}),
      .out_valid(disparity_in_valid), .out_ready(disparity_in_ready),
      .out_data({disparity_in_flow, disparity_x, disparity_y}), .count()
  );
  hmlfc_tile_store #(
      .KIND(hmlfc_pkg::DISPARITY_TILES), .DATA_BITS(DATA_BITS), .CONTEXTS(DISPARITY_CONTEXTS),
      .CONTEXT_WORDS(DISPARITY_WORDS)
  ) disparities (
      .clk, .rst_n, .stream, .flush, .ask(disparity_ask), .ask_tile(disparity_tile), .ask_info(disparity_info),
      .granted(disparity_granted), .granted_context(disparity_context), .in_valid(disparity_in_valid),
      .in_ready(disparity_in_ready), .in_flow(disparity_in_flow), .in_x(disparity_x), .in_y(disparity_y),
      .out_valid(disparity_valid), .out_ready(disparity_ready), .out_flow(disparity_flow), .out_has_residual(),
      .out_residual(), .load_valid(load_valid[2]), .load_ready(load_ready[2]), .load(loads[2*LOAD_BITS+:LOAD_BITS]),
      .write(write[2]), .write_beat(write_beat[$clog2(DISPARITY_CONTEXTS)+DISPARITY_LOG2-1:0]), .data,
      .parse_valid(parse_valid[2]), .parse_ready(parse_ready[2]), .parse(parses[2*PARSE_BITS+:PARSE_BITS])
  );

  hmlfc_tile_store #(
      .KIND(hmlfc_pkg::RESIDUAL_TILES), .BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .DATA_BITS(DATA_BITS),
      .CLOCKS(BLOCK_CLOCKS), .CONTEXTS(TILE_CONTEXTS), .CONTEXT_WORDS(RESIDUAL_WORDS)
  ) residuals (
      .clk, .rst_n, .stream, .flush, .ask(residual_ask), .ask_tile(residual_tile), .ask_info(residual_info),
      .granted(residual_granted), .granted_context(residual_context), .in_valid(disparity_valid),
      .in_ready(disparity_ready), .in_flow(disparity_flow), .in_x('0), .in_y('0), .out_valid, .out_ready, .out_flow,
      .out_has_residual, .out_residual, .load_valid(load_valid[0]), .load_ready(load_ready[0]),
      .load(loads[0*LOAD_BITS+:LOAD_BITS]), .write(write[0]),
      .write_beat(write_beat[$clog2(TILE_CONTEXTS)+RESIDUAL_LOG2-1:0]), .data, .parse_valid(parse_valid[0]),
      .parse_ready(parse_ready[0]), .parse(parses[0*PARSE_BITS+:PARSE_BITS])
  );

endmodule

`default_nettype wire
