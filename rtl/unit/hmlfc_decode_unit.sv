// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// The decode unit (docs/decode_unit.md): answers requests for blocks of an .hmlfc stream that lies in memory.
//
//   requests, view -> tiles: motion, disparity, residual -> references: windows of samples -> compose -> answers
//
// Everything is in order: a block never overtakes another. Slow reads start as soon as their address is known, and
// queues in `tiles` and `references` let blocks wait in line while memory answers. Each stage stalls when the next one
// does. `control` has the registers and LOAD, and gives all stages the geometry of the stream.
module hmlfc_decode_unit #(
    parameter int BLOCK_LOG2 = 2,      // 1..3
    parameter int MAX_DEPTH = 8,       // 8..12
    parameter int AXI_DATA_BITS = 128,  // 64, 128, 256
    parameter int OUTSTANDING = 64,    // 4..64
    parameter int TILE_CONTEXTS = 16,  // 2..32, a power of two
    parameter int CACHES = 2,          // 1, 2
    parameter int CACHE_STRIPS = 512,  // 64..1024, a power of two
    parameter int STRIP_READ = 32,     // 32, 64
    parameter int BLOCK_CLOCKS = 1,    // 1, 2, 4, at most 2^BLOCK_LOG2: that the samples of a block take
    parameter int TRACE = 1,           // 0..1; 0: nothing is kept for the trace, which is 0
    parameter logic [2:0] AXI_PROT = 3'b010,   // what AxPROT, AxCACHE and AxQOS are: data, not secure, not privileged;
    parameter logic [3:0] AXI_CACHE = 4'b0011, // normal memory, not cacheable, bufferable;
    parameter logic [3:0] AXI_QOS = 4'd0,      // no quality of service
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int SAMPLE_BITS = MAX_DEPTH + 1
) (
    input logic clk,
    input logic rst_n,

    input logic s_request_tvalid,
    output logic s_request_tready,
    input logic [63:0] s_request_tdata,
    input logic s_request_tlast,

    output logic m_response_tvalid,
    input logic m_response_tready,
    output logic [3*SAMPLES*16-1:0] m_response_tdata,
    output logic [5:0] m_response_tuser,
    output logic m_response_tlast,

    output logic m_axi_arvalid,
    input logic m_axi_arready,
    output logic [ADDRESS_BITS-1:0] m_axi_araddr,
    output logic [7:0] m_axi_arlen,
    output logic [2:0] m_axi_arsize,
    output logic [1:0] m_axi_arburst,
    output logic [0:0] m_axi_arid,
    output logic [2:0] m_axi_arprot,
    output logic [3:0] m_axi_arcache,
    output logic [3:0] m_axi_arqos,
    input logic m_axi_rvalid,
    output logic m_axi_rready,
    input logic [AXI_DATA_BITS-1:0] m_axi_rdata,
    input logic [1:0] m_axi_rresp,
    input logic m_axi_rlast,
    input logic [0:0] m_axi_rid,

    input logic s_axil_awvalid,
    output logic s_axil_awready,
    input logic [11:0] s_axil_awaddr,
    input logic s_axil_wvalid,
    output logic s_axil_wready,
    input logic [31:0] s_axil_wdata,
    input logic [3:0] s_axil_wstrb,
    output logic s_axil_bvalid,
    input logic s_axil_bready,
    output logic [1:0] s_axil_bresp,
    input logic s_axil_arvalid,
    output logic s_axil_arready,
    input logic [11:0] s_axil_araddr,
    output logic s_axil_rvalid,
    input logic s_axil_rready,
    output logic [31:0] s_axil_rdata,
    output logic [1:0] s_axil_rresp,

    // The clock is needed.
    output logic active,

    // Trace of each block of a level, in decoding order; for simulation.
    output logic trace_valid,
    output logic [3:0] trace_level,
    output logic [1:0] trace_plane,
    output logic [14:0] trace_bx,
    output logic [14:0] trace_by,
    output logic [11:0] trace_row,
    output logic [11:0] trace_col,
    output logic trace_key,
    output logic trace_motion,
    output logic trace_negative,
    output logic [1:0] trace_references,
    output logic [8:0] trace_ix_a,
    output logic [8:0] trace_iy_a,
    output logic [2:0] trace_fx_a,
    output logic [2:0] trace_fy_a,
    output logic [8:0] trace_ix_b,
    output logic [8:0] trace_iy_b,
    output logic [2:0] trace_fx_b,
    output logic [2:0] trace_fy_b,
    output logic trace_has_residual,
    output logic [SAMPLES*VALUE_BITS-1:0] trace_residual,
    output logic [SAMPLES*VALUE_BITS-1:0] trace_reference,
    output logic [SAMPLES*SAMPLE_BITS-1:0] trace_prediction,
    output logic [SAMPLES*SAMPLE_BITS-1:0] trace_sample,
    output logic [5:0] trace_error
);

`ifndef __ICARUS__  // version 11 has no elaboration tasks
  if (BLOCK_LOG2 < 1 || BLOCK_LOG2 > 3) begin : check_block_log2 $error("BLOCK_LOG2 is 1, 2 or 3"); end
  if (MAX_DEPTH < 8 || MAX_DEPTH > 12) begin : check_max_depth $error("MAX_DEPTH is 8 to 12"); end
  if (AXI_DATA_BITS != 64 && AXI_DATA_BITS != 128 && AXI_DATA_BITS != 256) begin : check_axi_data_bits
    $error("AXI_DATA_BITS is 64, 128 or 256");
  end
  if (OUTSTANDING < 4 || OUTSTANDING > 64) begin : check_outstanding $error("OUTSTANDING is 4 to 64"); end
  if (TILE_CONTEXTS < 2 || TILE_CONTEXTS > 32 || (TILE_CONTEXTS & (TILE_CONTEXTS - 1)) != 0) begin : check_tile_contexts
    $error("TILE_CONTEXTS is a power of two, 2 to 32");
  end
  if (CACHES != 1 && CACHES != 2) begin : check_caches $error("CACHES is 1 or 2"); end
  if (CACHE_STRIPS < 64 || CACHE_STRIPS > 1024 || (CACHE_STRIPS & (CACHE_STRIPS - 1)) != 0) begin : check_cache_strips
    $error("CACHE_STRIPS is a power of two, 64 to 1024");
  end
  if (STRIP_READ != 32 && STRIP_READ != 64) begin : check_strip_read $error("STRIP_READ is 32 or 64"); end
  if (BLOCK_CLOCKS < 1 || BLOCK_CLOCKS == 3 || BLOCK_CLOCKS > (BLOCK_LOG2 == 1 ? 2 : 4)) begin : check_block_clocks
    $error("BLOCK_CLOCKS is 1, 2 or 4, and at most the rows of a block");
  end
  if (TRACE < 0 || TRACE > 1) begin : check_trace $error("TRACE is 0 or 1"); end
`endif

  hmlfc_widths widths ();

  localparam int TILE_CLIENTS = 2;
  localparam int CLIENTS = 1 + TILE_CLIENTS + 2;  // of the read master, the first most urgent
  localparam int READ_REQUEST_BITS = hmlfc_pkg::READ_REQUEST_BITS;
  localparam int READ_RESPONSE_BITS = hmlfc_pkg::READ_RESPONSE_BITS;
  localparam int VIEW_BITS = hmlfc_pkg::VIEW_BITS;
  localparam int VIEWS = BLOCK_CLOCKS > 1 ? 4 : hmlfc_pkg::VIEWS;  // held
  localparam int SLOT_BITS = $clog2(VIEWS);
  localparam int LEVELS = hmlfc_pkg::LEVELS;
  localparam int LEVEL_BITS = hmlfc_pkg::LEVEL_BITS;
  localparam int RESIDUAL_BITS = SAMPLES * VALUE_BITS;
  localparam int WINDOW_BITS = ((1 << BLOCK_LOG2) / BLOCK_CLOCKS + 1) * ((1 << BLOCK_LOG2) + 1) * VALUE_BITS;
  localparam int REQUESTS = 512;  // in flight at once, at most

  // ---- The read master and its clients.
  logic [CLIENTS*READ_REQUEST_BITS-1:0] read_requests;
  logic [CLIENTS*READ_RESPONSE_BITS-1:0] read_responses;
  logic [AXI_DATA_BITS-1:0] data;
  logic reading, stray;
  hmlfc_read_port #(.CLIENTS(CLIENTS), .DATA_BITS(AXI_DATA_BITS), .OUTSTANDING(OUTSTANDING)) port (
      .clk, .rst_n, .requests(read_requests), .responses(read_responses), .data, .reading, .stray, .m_axi_arvalid,
      .m_axi_arready, .m_axi_araddr, .m_axi_arlen, .m_axi_arsize, .m_axi_arburst, .m_axi_rvalid, .m_axi_rready,
      .m_axi_rdata, .m_axi_rresp, .m_axi_rlast
  );
  assign m_axi_arid = 1'b0;
  assign {m_axi_arprot, m_axi_arcache, m_axi_arqos} = {AXI_PROT, AXI_CACHE, AXI_QOS};

  // ---- Registers and LOAD.
  logic loading, enable, flush, idle, block_done;
  logic [5:0] load_error;
  logic [63:0] first_request;
  hmlfc_pkg::config_t stream;
  logic [LEVELS*LEVEL_BITS-1:0] levels;
  wire asked = s_request_tvalid && s_request_tready;
  wire answered = m_response_tvalid && m_response_tready;
  hmlfc_control #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .DATA_BITS(AXI_DATA_BITS)) control (
      .clk, .rst_n, .s_axil_awvalid, .s_axil_awready, .s_axil_awaddr, .s_axil_wvalid, .s_axil_wready, .s_axil_wdata,
      .s_axil_wstrb, .s_axil_bvalid, .s_axil_bready, .s_axil_bresp, .s_axil_arvalid, .s_axil_arready, .s_axil_araddr,
      .s_axil_rvalid, .s_axil_rready, .s_axil_rdata, .s_axil_rresp, .idle, .reading, .stray, .loading, .enable,
      .load_error, .flush, .stream, .levels, .block_done, .answered, .answer_error(m_response_tuser),
      .answered_request(first_request), .stalled(m_response_tvalid && !m_response_tready),
      .beat(m_axi_rvalid && m_axi_rready), .request(read_requests[0+:READ_REQUEST_BITS]),
      .response(read_responses[0+:READ_RESPONSE_BITS]), .data
  );

  // ---- Whether the clock is needed.
  wire accessed = !s_axil_awready || !s_axil_wready || s_axil_bvalid || s_axil_rvalid;
  hmlfc_activity #(.CHANNELS(5), .PARTS(4)) activity (
      .clk, .rst_n, .offered({s_request_tvalid, m_axi_rvalid, s_axil_awvalid, s_axil_wvalid, s_axil_arvalid}),
      .busy({accessed, loading, !idle, reading}), .active
  );

  // ---- Requests in flight.
  logic requests_ready, requests_valid, list_ready;
  logic done_valid, done_ready;
  hmlfc_pkg::pending_t done_pending;  // the job that leaves
  hmlfc_fifo #(.WIDTH(64), .DEPTH(REQUESTS)) requested (
      .clk, .rst_n, .in_valid(asked), .in_ready(list_ready), .in_data(s_request_tdata), .out_valid(requests_valid),
      .out_ready(answered), .out_data(first_request), .count()
  );
  assign idle = !requests_valid;
  assign s_request_tready = requests_ready && list_ready;

  logic view_start, view_done, image_write;
  logic [SLOT_BITS-1:0] view_slot;
  logic [9:0] view_row, view_col;
  logic [LEVELS-1:0] view_keys;
  logic [2:0] image_level;
  hmlfc_pkg::image_t view_image;
  hmlfc_pkg::image_tiles_t ask_image;
  logic [hmlfc_pkg::TILE_BITS-1:0] disparity_first_tile;
  hmlfc_pkg::image_references_t reference_image;
  logic job_valid, job_ready, chroma_spoiled;
  hmlfc_pkg::job_t job;
  hmlfc_requests #(.VIEWS(VIEWS)) requests (
      .clk, .rst_n, .stream, .enable, .load_error, .flush, .s_valid(s_request_tvalid && list_ready),
      .s_ready(requests_ready), .s_data(s_request_tdata), .s_last(s_request_tlast), .view_start, .view_row, .view_col,
      .view_slot, .view_done, .view_keys, .job_valid, .job_ready, .job, .chroma_spoiled, .finished_valid(block_done),
      .finished_slot(done_pending.job.id[3+:SLOT_BITS])
  );
  hmlfc_view #(.UNITS(BLOCK_CLOCKS > 1 ? 1 : 2)) view (
      .clk, .rst_n, .stream, .levels, .start(view_start), .view_row, .view_col, .done(view_done), .keys(view_keys),
      .write(image_write), .write_level(image_level), .write_image(view_image)
  );

  // ---- The block's records.
  logic [VIEW_BITS+2:0] disparity_id;
  logic tiles_valid, tiles_ready, flow_valid, flow_ready, has_residual;
  hmlfc_pkg::job_t tiles_job;
  hmlfc_pkg::image_tiles_t tiles_image;
  hmlfc_pkg::flow_t flow;
  logic [RESIDUAL_BITS-1:0] residual;
  // Whether the contexts take a job is known late in a clock; `requests` needs a clock of its own.
  hmlfc_skid_buffer #(.WIDTH(hmlfc_pkg::JOB_BITS + hmlfc_pkg::IMAGE_TILES_BITS)) jobs (
      .clk, .rst_n, .in_valid(job_valid), .in_ready(job_ready), .in_data({job, ask_image}), .out_valid(tiles_valid),
      .out_ready(tiles_ready), .out_data({tiles_job, tiles_image})
  );
  hmlfc_tile_stores #(
      .BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .DATA_BITS(AXI_DATA_BITS), .TILE_CONTEXTS(TILE_CONTEXTS),
      .BLOCK_CLOCKS(BLOCK_CLOCKS)
  ) tiles (
      .clk, .rst_n, .stream, .flush, .in_valid(tiles_valid), .in_ready(tiles_ready), .in_job(tiles_job),
      .in_image(tiles_image), .disparity_id, .disparity_first_tile, .out_valid(flow_valid), .out_ready(flow_ready),
      .out_flow(flow), .out_has_residual(has_residual), .out_residual(residual),
      .requests(read_requests[READ_REQUEST_BITS+:TILE_CLIENTS*READ_REQUEST_BITS]),
      .responses(read_responses[READ_RESPONSE_BITS+:TILE_CLIENTS*READ_RESPONSE_BITS]), .data
  );

  // ---- The block's references; what its image has of them is read in a clock of its own.
  logic placed_valid, placed_ready, placed_has_residual;
  hmlfc_pkg::flow_t placed;
  logic [RESIDUAL_BITS-1:0] placed_residual;
  assign flow_ready = !placed_valid || placed_ready;
  always_ff @(posedge clk) begin
    if (flow_ready) {placed, placed_has_residual, placed_residual} <= {flow, has_residual, residual};
    placed_valid <= rst_n && (flow_valid || !flow_ready);
  end
  logic pending_valid, pending_ready;
  hmlfc_pkg::pending_t pending;
  logic [RESIDUAL_BITS-1:0] pending_residual;
  logic [1:0] window_valid, window_ready;
  logic [2*6-1:0] window_error;
  logic [2*WINDOW_BITS-1:0] window;
  hmlfc_references #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .DATA_BITS(AXI_DATA_BITS),
      .CACHES(CACHES), .CACHE_STRIPS(CACHE_STRIPS), .FILLS(1 << $clog2(OUTSTANDING)),
      .STRIP_READ(STRIP_READ), .CLOCKS(BLOCK_CLOCKS)) references (
      .clk, .rst_n, .stream, .flush, .in_valid(placed_valid), .in_ready(placed_ready), .in_flow(placed),
      .in_image(reference_image), .in_has_residual(placed_has_residual), .in_residual(placed_residual),
      .out_valid(pending_valid), .out_ready(pending_ready), .out_pending(pending), .out_residual(pending_residual),
      .window_valid, .window_ready,
      .window_error, .window, .requests(read_requests[(1+TILE_CLIENTS)*READ_REQUEST_BITS+:2*READ_REQUEST_BITS]),
      .responses(read_responses[(1+TILE_CLIENTS)*READ_RESPONSE_BITS+:2*READ_RESPONSE_BITS]), .data
  );

  // ---- Samples and answers.
  logic [5:0] done_error;
  logic [SAMPLES*SAMPLE_BITS-1:0] done_sample, done_prediction;
  logic [SAMPLES*VALUE_BITS-1:0] done_residual, done_reference;
  hmlfc_compose #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .CLOCKS(BLOCK_CLOCKS), .TRACE(TRACE)) compose (
      .clk, .rst_n, .depth(stream.depth), .in_valid(pending_valid), .in_ready(pending_ready), .in_pending(pending),
      .in_residual(pending_residual), .a_valid(window_valid[0]), .a_ready(window_ready[0]),
      .a_error(window_error[0+:6]), .a_window(window[0+:WINDOW_BITS]), .b_valid(window_valid[1]),
      .b_ready(window_ready[1]), .b_error(window_error[6+:6]), .b_window(window[WINDOW_BITS+:WINDOW_BITS]),
      .out_valid(done_valid), .out_ready(done_ready), .out_pending(done_pending), .out_error(done_error),
      .out_sample(done_sample), .out_residual(done_residual), .out_reference(done_reference),
      .out_prediction(done_prediction)
  );
  assign block_done = done_valid && done_ready;
  hmlfc_answer #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .CLOCKS(BLOCK_CLOCKS)) answers (
      .clk, .rst_n, .depth(stream.depth), .chroma_444(stream.chroma_444), .in_valid(done_valid), .in_ready(done_ready),
      .in_job(done_pending.job), .in_error(done_error), .in_sample(done_sample),
      .in_has_residual(done_pending.has_residual), .in_residual(done_residual), .chroma_spoiled,
      .out_valid(m_response_tvalid), .out_ready(m_response_tready), .out_data(m_response_tdata),
      .out_error(m_response_tuser), .out_last(m_response_tlast)
  );

  logic [hmlfc_pkg::GRID_BITS-1:0] done_row, done_col;
  hmlfc_images #(.TRACE(TRACE)) images (
      .clk, .shallow(stream.tree_height < 3'd4), .write(image_write), .write_image(view_image),
      .write_id((VIEW_BITS + 3)'({view_slot, image_level})), .tiles_id(job.id), .tiles(ask_image), .disparity_id,
      .disparity_tile(disparity_first_tile), .references_read(flow_ready), .references_id(flow.job.id),
      .references(reference_image), .place_id(done_pending.job.id), .place({done_row, done_col})
  );

  if (TRACE != 0) begin : g_trace
    assign {trace_valid, trace_level, trace_plane} = {block_done, 4'(done_pending.job.id[2:0]), done_pending.job.plane};
    assign {trace_bx, trace_by} = {15'(done_pending.job.bx), 15'(done_pending.job.by)};
    assign {trace_row, trace_col} = {12'(done_row), 12'(done_col)};
    assign {trace_key, trace_motion, trace_negative} = {done_pending.key, done_pending.motion, done_pending.negative};
    assign trace_references = !done_pending.motion ? 2'd0 : done_pending.two ? 2'd2 : 2'd1;
    assign {trace_ix_a, trace_iy_a, trace_fx_a, trace_fy_a} =
        {done_pending.ix_a, done_pending.iy_a, done_pending.fx_a, done_pending.fy_a};
    assign {trace_ix_b, trace_iy_b, trace_fx_b, trace_fy_b} =
        {done_pending.ix_b, done_pending.iy_b, done_pending.fx_b, done_pending.fy_b};
    assign trace_has_residual = done_pending.has_residual;
    assign {trace_residual, trace_reference, trace_prediction} = {done_residual, done_reference, done_prediction};
    assign {trace_sample, trace_error} = {done_sample, done_error};
  end else begin : g_no_trace
    assign {trace_valid, trace_level, trace_plane, trace_bx, trace_by, trace_row, trace_col, trace_key, trace_motion,
        trace_negative} = '0;
    assign {trace_references, trace_ix_a, trace_iy_a, trace_fx_a, trace_fy_a, trace_ix_b, trace_iy_b, trace_fx_b,
        trace_fy_b} = '0;
    assign {trace_has_residual, trace_residual, trace_reference, trace_prediction, trace_sample, trace_error} = '0;
  end

endmodule

`default_nettype wire
