`include "hmlfc_tables.svh"

// The decode unit (docs/hardware.md): answers requests for blocks of an .hmlfc stream that lies in memory.
//
//   requests -> tile_ask -> motion_store -> disparity_ask -> disparity_store -> residual_store -> reference_ask -> compose -> answer
//                  |            ^ walks ahead      |              ^                  ^ asked for       |    |          ^
//                  +-- asks for both tiles ahead --+--------------+------------------+ by tile_ask     +-> cache A, B -+
//
// Everything is in order: a block never overtakes another. What takes long is asked for as early as its place is known, and
// queues between the stages let blocks wait in line while memory answers: tiles by tile_ask and disparity_ask, reference
// samples by reference_ask. Each stage stands still when the one after it does.
module hmlfc_decode_unit #(
    parameter int BLOCK_LOG2 = 2,      // 1..3
    parameter int MAX_DEPTH = 8,       // 8..12
    parameter int AXI_DATA_BITS = 128,  // 64, 128
    parameter int OUTSTANDING = 32,    // 4..64
    parameter int TILE_CONTEXTS = 16,  // 2..32, a power of two
    parameter int CACHE_STRIPS = 512,  // 64..1024, a power of two
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

    // What each block of a level was made of, in the order of decoding; for simulation, and left open in a chip.
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

  if (BLOCK_LOG2 < 1 || BLOCK_LOG2 > 3) $error("BLOCK_LOG2 is 1, 2 or 3");
  if (MAX_DEPTH < 8 || MAX_DEPTH > 12) $error("MAX_DEPTH is 8 to 12");
  if (AXI_DATA_BITS != 64 && AXI_DATA_BITS != 128) $error("AXI_DATA_BITS is 64 or 128");
  if (OUTSTANDING < 4 || OUTSTANDING > 64) $error("OUTSTANDING is 4 to 64");
  if (TILE_CONTEXTS < 2 || TILE_CONTEXTS > 32 || (TILE_CONTEXTS & (TILE_CONTEXTS - 1)) != 0) $error("TILE_CONTEXTS is a power of two, 2 to 32");
  if (CACHE_STRIPS < 64 || CACHE_STRIPS > 1024 || (CACHE_STRIPS & (CACHE_STRIPS - 1)) != 0) $error("CACHE_STRIPS is a power of two, 64 to 1024");

`ifdef VERILATOR
  if ($bits(hmlfc_pkg::level_t) != hmlfc_pkg::LEVEL_BITS || $bits(hmlfc_pkg::image_t) != hmlfc_pkg::IMAGE_BITS ||
      $bits(hmlfc_pkg::job_t) != hmlfc_pkg::JOB_BITS || $bits(hmlfc_pkg::motion_t) != hmlfc_pkg::MOTION_BITS ||
      $bits(hmlfc_pkg::flow_t) != hmlfc_pkg::FLOW_BITS || $bits(hmlfc_pkg::pending_t) != hmlfc_pkg::PENDING_BITS) begin : g_widths
    $error("hmlfc_pkg: the widths of the structures are other ones");
  end
`endif

  localparam int CLIENTS = 6;  // of the read master, the first most urgent
  localparam int LEVELS = hmlfc_pkg::LEVELS;
  localparam int LEVEL_BITS = hmlfc_pkg::LEVEL_BITS;
  localparam int FLOW_BITS = hmlfc_pkg::FLOW_BITS;
  localparam int PENDING_BITS = hmlfc_pkg::PENDING_BITS;
  localparam int RESIDUAL_BITS = SAMPLES * VALUE_BITS;
  localparam int WINDOW_BITS = ((1 << BLOCK_LOG2) + 1) * ((1 << BLOCK_LOG2) + 1) * VALUE_BITS;
  localparam int MOTION_CONTEXTS = 4;
  localparam int DISPARITY_CONTEXTS = 4;
  localparam int REQUESTS = 512;  // under way at once, at most

  // ---- The read master and its clients.
  logic [CLIENTS-1:0] request_valid, request_ready, data_valid;
  logic [CLIENTS*ADDRESS_BITS-1:0] request_address;
  logic [CLIENTS*10-1:0] request_beats;
  logic [AXI_DATA_BITS-1:0] data;
  logic data_last, data_error;
  hmlfc_read_port #(
      .CLIENTS(CLIENTS),
      .DATA_BITS(AXI_DATA_BITS),
      .ADDRESS_BITS(ADDRESS_BITS),
      .OUTSTANDING(OUTSTANDING)
  ) port (
      .clk,
      .rst_n,
      .request_valid,
      .request_ready,
      .request_address,
      .request_beats,
      .data_valid,
      .data,
      .data_last,
      .data_error,
      .m_axi_arvalid,
      .m_axi_arready,
      .m_axi_araddr,
      .m_axi_arlen,
      .m_axi_arsize,
      .m_axi_arburst,
      .m_axi_rvalid,
      .m_axi_rready,
      .m_axi_rdata,
      .m_axi_rresp,
      .m_axi_rlast
  );
  assign m_axi_arid = 1'b0;

  // ---- Registers and LOAD.
  logic [63:0] stream_base, stream_bytes, reference_base, first_request;
  logic load, disable_unit, loading, enable, flush, idle;
  logic [5:0] load_error;
  hmlfc_pkg::config_t stream;
  logic [LEVELS*LEVEL_BITS-1:0] levels;
  wire asked = s_request_tvalid && s_request_tready;
  wire answered = m_response_tvalid && m_response_tready;
  logic block_done;
  hmlfc_registers #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .MAX_DEPTH(MAX_DEPTH),
      .AXI_DATA_BITS(AXI_DATA_BITS)
  ) registers (
      .clk,
      .rst_n,
      .s_axil_awaddr(s_axil_awaddr[7:0]),
      .s_axil_araddr(s_axil_araddr[7:0]),
      .s_axil_awvalid,
      .s_axil_awready,
      .s_axil_wdata,
      .s_axil_wstrb,
      .s_axil_wvalid,
      .s_axil_wready,
      .s_axil_bresp,
      .s_axil_bvalid,
      .s_axil_bready,
      .s_axil_arvalid,
      .s_axil_arready,
      .s_axil_rdata,
      .s_axil_rresp,
      .s_axil_rvalid,
      .s_axil_rready,
      .stream_base,
      .stream_bytes,
      .reference_base,
      .load,
      .disable_unit,
      .ready(enable && load_error == 0),
      .loading,
      .idle,
      .load_error,
      .error_valid(answered && m_response_tuser != 0),
      .error(m_response_tuser),
      .error_request(first_request),
      .block_done,
      .in_flight(!idle),
      .stalled(m_response_tvalid && !m_response_tready),
      .read_bytes(m_axi_rvalid && m_axi_rready ? 5'(AXI_DATA_BITS / 8) : 5'd0),
      .answered
  );
  hmlfc_loader #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .MAX_DEPTH(MAX_DEPTH),
      .DATA_BITS(AXI_DATA_BITS)
  ) loader (
      .clk,
      .rst_n,
      .load,
      .disable_unit,
      .idle,
      .loading,
      .enable,
      .flush,
      .error(load_error),
      .stream_base,
      .stream_bytes,
      .reference_base,
      .stream,
      .levels,
      .request_valid(request_valid[0]),
      .request_ready(request_ready[0]),
      .request_address(request_address[0*ADDRESS_BITS+:ADDRESS_BITS]),
      .request_beats(request_beats[0*10+:10]),
      .data_valid(data_valid[0]),
      .data,
      .data_last,
      .data_error
  );

  // ---- Requests, as long as they are under way.
  logic requests_ready, requests_valid, list_ready;
  /* verilator lint_off PINCONNECTEMPTY */
  hmlfc_fifo #(
      .WIDTH(64),
      .DEPTH(REQUESTS)
  ) requested (
      .clk,
      .rst_n,
      .in_valid(asked),
      .in_ready(list_ready),
      .in_data(s_request_tdata),
      .out_valid(requests_valid),
      .out_ready(answered),
      .out_data(first_request),
      .count()
  );
  /* verilator lint_on PINCONNECTEMPTY */
  assign idle = !requests_valid;
  assign s_request_tready = requests_ready && list_ready;

  logic view_start, view_slot, view_done, image_write;
  logic [9:0] view_row, view_col;
  logic [LEVELS-1:0] view_keys;
  logic [2:0] image_level;
  hmlfc_pkg::image_t view_image, ask_image, disparity_image, reference_image;
  logic job_valid, job_ready, chroma_spoiled;
  hmlfc_pkg::job_t job;
  hmlfc_requests requests (
      .clk,
      .rst_n,
      .stream,
      .enable,
      .load_error,
      .flush,
      .s_valid(s_request_tvalid && list_ready),
      .s_ready(requests_ready),
      .s_data(s_request_tdata),
      .s_last(s_request_tlast),
      .view_start,
      .view_row,
      .view_col,
      .view_slot,
      .view_done,
      .view_keys,
      .job_valid,
      .job_ready,
      .job,
      .chroma_spoiled,
      .finished_valid(block_done),
      .finished_slot(done_pending.job.id[3])
  );
  hmlfc_view view (
      .clk,
      .rst_n,
      .stream,
      .levels,
      .start(view_start),
      .view_row,
      .view_col,
      .done(view_done),
      .keys(view_keys),
      .write(image_write),
      .write_level(image_level),
      .write_image(view_image)
  );

  // ---- Tiles: asked for, then used in the order motion, disparity, residual.
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
      .BLOCK_LOG2(BLOCK_LOG2),
      .RESIDUAL_CONTEXTS(TILE_CONTEXTS),
      .MOTION_CONTEXTS(MOTION_CONTEXTS)
  ) tile_ask (
      .clk,
      .rst_n,
      .stream,
      .image(ask_image),
      .in_valid(job_valid),
      .in_ready(job_ready),
      .in_job(job),
      .residual_ask,
      .residual_tile,
      .residual_info,
      .residual_granted,
      .residual_context,
      .motion_ask,
      .motion_tile,
      .motion_info,
      .motion_granted,
      .motion_context,
      .out_valid(ask_valid),
      .out_ready(ask_ready),
      .out_flow(ask_flow)
  );
  /* verilator lint_off PINCONNECTEMPTY */
  hmlfc_fifo #(
      .WIDTH(FLOW_BITS),
      .DEPTH(128)
  ) before_motion (
      .clk,
      .rst_n,
      .in_valid(ask_valid),
      .in_ready(ask_ready),
      .in_data(ask_flow),
      .out_valid(motion_in_valid),
      .out_ready(motion_in_ready),
      .out_data(motion_in_flow),
      .count()
  );
  /* verilator lint_on PINCONNECTEMPTY */
  hmlfc_motion_store #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .DATA_BITS(AXI_DATA_BITS),
      .CONTEXTS(MOTION_CONTEXTS)
  ) motions (
      .clk,
      .rst_n,
      .stream,
      .flush,
      .ask(motion_ask),
      .ask_tile(motion_tile),
      .ask_info(motion_info),
      .granted(motion_granted),
      .granted_context(motion_context),
      .in_valid(motion_in_valid),
      .in_ready(motion_in_ready),
      .in_flow(motion_in_flow),
      .out_valid(motion_valid),
      .out_ready(motion_ready),
      .out_flow(motion_flow),
      .request_valid(request_valid[2]),
      .request_ready(request_ready[2]),
      .request_address(request_address[2*ADDRESS_BITS+:ADDRESS_BITS]),
      .request_beats(request_beats[2*10+:10]),
      .data_valid(data_valid[2]),
      .data,
      .data_last,
      .data_error
  );

  logic shared_valid, shared_ready, disparity_in_valid, disparity_in_ready, disparity_valid, disparity_ready;
  hmlfc_pkg::flow_t shared_flow, disparity_in_flow, disparity_flow;
  logic [4:0] shared_x, shared_y, disparity_x, disparity_y;
  hmlfc_disparity_ask #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .CONTEXTS(DISPARITY_CONTEXTS)
  ) disparity_asking (
      .clk,
      .rst_n,
      .stream,
      .image(disparity_image),
      .in_valid(motion_valid),
      .in_ready(motion_ready),
      .in_flow(motion_flow),
      .ask(disparity_ask),
      .ask_tile(disparity_tile),
      .ask_info(disparity_info),
      .granted(disparity_granted),
      .granted_context(disparity_context),
      .out_valid(shared_valid),
      .out_ready(shared_ready),
      .out_flow(shared_flow),
      .out_x(shared_x),
      .out_y(shared_y)
  );
  /* verilator lint_off PINCONNECTEMPTY */
  hmlfc_fifo #(
      .WIDTH(FLOW_BITS + 10),
      .DEPTH(64)
  ) before_disparity (
      .clk,
      .rst_n,
      .in_valid(shared_valid),
      .in_ready(shared_ready),
      .in_data({shared_flow, shared_x, shared_y}),
      .out_valid(disparity_in_valid),
      .out_ready(disparity_in_ready),
      .out_data({disparity_in_flow, disparity_x, disparity_y}),
      .count()
  );
  /* verilator lint_on PINCONNECTEMPTY */
  hmlfc_disparity_store #(
      .DATA_BITS(AXI_DATA_BITS),
      .CONTEXTS(DISPARITY_CONTEXTS)
  ) disparities (
      .clk,
      .rst_n,
      .stream,
      .flush,
      .ask(disparity_ask),
      .ask_tile(disparity_tile),
      .ask_info(disparity_info),
      .granted(disparity_granted),
      .granted_context(disparity_context),
      .in_valid(disparity_in_valid),
      .in_ready(disparity_in_ready),
      .in_flow(disparity_in_flow),
      .in_x(disparity_x),
      .in_y(disparity_y),
      .out_valid(disparity_valid),
      .out_ready(disparity_ready),
      .out_flow(disparity_flow),
      .request_valid(request_valid[3]),
      .request_ready(request_ready[3]),
      .request_address(request_address[3*ADDRESS_BITS+:ADDRESS_BITS]),
      .request_beats(request_beats[3*10+:10]),
      .data_valid(data_valid[3]),
      .data,
      .data_last,
      .data_error
  );

  logic residual_valid, residual_ready, has_residual;
  hmlfc_pkg::flow_t residual_flow;
  logic [RESIDUAL_BITS-1:0] residual;
  hmlfc_residual_store #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .MAX_DEPTH(MAX_DEPTH),
      .DATA_BITS(AXI_DATA_BITS),
      .CONTEXTS(TILE_CONTEXTS)
  ) residuals (
      .clk,
      .rst_n,
      .stream,
      .flush,
      .ask(residual_ask),
      .ask_tile(residual_tile),
      .ask_info(residual_info),
      .granted(residual_granted),
      .granted_context(residual_context),
      .in_valid(disparity_valid),
      .in_ready(disparity_ready),
      .in_flow(disparity_flow),
      .out_valid(residual_valid),
      .out_ready(residual_ready),
      .out_flow(residual_flow),
      .out_has_residual(has_residual),
      .out_residual(residual),
      .request_valid(request_valid[1]),
      .request_ready(request_ready[1]),
      .request_address(request_address[1*ADDRESS_BITS+:ADDRESS_BITS]),
      .request_beats(request_beats[1*10+:10]),
      .data_valid(data_valid[1]),
      .data,
      .data_last,
      .data_error
  );

  // ---- References.
  localparam int SLOT_BITS = ADDRESS_BITS + 80;
  logic a_valid, a_ready, b_valid, b_ready, a_out_valid, a_out_ready, b_out_valid, b_out_ready;
  logic a_in_valid, a_in_ready, b_in_valid, b_in_ready;
  logic [SLOT_BITS-1:0] a_window, b_window, a_in_window, b_in_window;
  logic [5:0] a_error, b_error;
  logic [WINDOW_BITS-1:0] a_samples, b_samples;
  logic pending_valid, pending_ready, next_valid, next_ready;
  hmlfc_pkg::pending_t pending, next_pending;
  logic [RESIDUAL_BITS-1:0] pending_residual, next_residual;
  hmlfc_reference_ask #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .RESIDUAL_BITS(RESIDUAL_BITS)
  ) reference_ask (
      .clk,
      .rst_n,
      .stream,
      .image(reference_image),
      .in_flow(residual_flow),
      .in_valid(residual_valid),
      .in_ready(residual_ready),
      .in_has_residual(has_residual),
      .in_residual(residual),
      .a_valid,
      .a_ready,
      .a_window,
      .b_valid,
      .b_ready,
      .b_window,
      .out_valid(pending_valid),
      .out_ready(pending_ready),
      .out_pending(pending),
      .out_residual(pending_residual)
  );
  // A miss of one cache does not hold up the other.
  /* verilator lint_off PINCONNECTEMPTY */
  hmlfc_fifo #(
      .WIDTH(SLOT_BITS),
      .DEPTH(8)
  ) before_cache_a (
      .clk,
      .rst_n,
      .in_valid(a_valid),
      .in_ready(a_ready),
      .in_data(a_window),
      .out_valid(a_in_valid),
      .out_ready(a_in_ready),
      .out_data(a_in_window),
      .count()
  );
  hmlfc_reference_cache #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .SAMPLE_BITS(VALUE_BITS),
      .DATA_BITS(AXI_DATA_BITS),
      .STRIPS(CACHE_STRIPS)
  ) cache_a (
      .clk,
      .rst_n,
      .flush,
      .in_valid(a_in_valid),
      .in_ready(a_in_ready),
      .in_address(a_in_window[79+:ADDRESS_BITS]),
      .in_plane(a_in_window[77+:2]),
      .in_section(a_in_window[ADDRESS_BITS+79]),
      .in_strips_x(a_in_window[66+:11]),
      .in_width(a_in_window[51+:15]),
      .in_height(a_in_window[36+:15]),
      .in_x(a_in_window[19+:17]),
      .in_y(a_in_window[2+:17]),
      .in_extra_x(a_in_window[1]),
      .in_extra_y(a_in_window[0]),
      .out_valid(a_out_valid),
      .out_ready(a_out_ready),
      .out_error(a_error),
      .out_window(a_samples),
      .request_valid(request_valid[4]),
      .request_ready(request_ready[4]),
      .request_address(request_address[4*ADDRESS_BITS+:ADDRESS_BITS]),
      .request_beats(request_beats[4*10+:10]),
      .data_valid(data_valid[4]),
      .data,
      .data_last,
      .data_error
  );
  hmlfc_fifo #(
      .WIDTH(SLOT_BITS),
      .DEPTH(8)
  ) before_cache_b (
      .clk,
      .rst_n,
      .in_valid(b_valid),
      .in_ready(b_ready),
      .in_data(b_window),
      .out_valid(b_in_valid),
      .out_ready(b_in_ready),
      .out_data(b_in_window),
      .count()
  );
  hmlfc_reference_cache #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .SAMPLE_BITS(VALUE_BITS),
      .DATA_BITS(AXI_DATA_BITS),
      .STRIPS(2 * CACHE_STRIPS),
      .SECTIONS(2)
  ) cache_b (
      .clk,
      .rst_n,
      .flush,
      .in_valid(b_in_valid),
      .in_ready(b_in_ready),
      .in_address(b_in_window[79+:ADDRESS_BITS]),
      .in_plane(b_in_window[77+:2]),
      .in_section(b_in_window[ADDRESS_BITS+79]),
      .in_strips_x(b_in_window[66+:11]),
      .in_width(b_in_window[51+:15]),
      .in_height(b_in_window[36+:15]),
      .in_x(b_in_window[19+:17]),
      .in_y(b_in_window[2+:17]),
      .in_extra_x(b_in_window[1]),
      .in_extra_y(b_in_window[0]),
      .out_valid(b_out_valid),
      .out_ready(b_out_ready),
      .out_error(b_error),
      .out_window(b_samples),
      .request_valid(request_valid[5]),
      .request_ready(request_ready[5]),
      .request_address(request_address[5*ADDRESS_BITS+:ADDRESS_BITS]),
      .request_beats(request_beats[5*10+:10]),
      .data_valid(data_valid[5]),
      .data,
      .data_last,
      .data_error
  );
  hmlfc_fifo #(
      .WIDTH(PENDING_BITS + RESIDUAL_BITS),
      .DEPTH(256)
  ) before_compose (
      .clk,
      .rst_n,
      .in_valid(pending_valid),
      .in_ready(pending_ready),
      .in_data({pending, pending_residual}),
      .out_valid(next_valid),
      .out_ready(next_ready),
      .out_data({next_pending, next_residual}),
      .count()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  // ---- Samples and answers.
  logic done_valid, done_ready;
  hmlfc_pkg::pending_t done_pending;
  logic [5:0] done_error;
  logic [SAMPLES*SAMPLE_BITS-1:0] done_sample;
  hmlfc_compose #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .MAX_DEPTH(MAX_DEPTH)
  ) compose (
      .clk,
      .rst_n,
      .depth(stream.depth),
      .in_valid(next_valid),
      .in_ready(next_ready),
      .in_pending(next_pending),
      .in_residual(next_residual),
      .a_valid(a_out_valid),
      .a_ready(a_out_ready),
      .a_error,
      .a_window(a_samples),
      .b_valid(b_out_valid),
      .b_ready(b_out_ready),
      .b_error,
      .b_window(b_samples),
      .out_valid(done_valid),
      .out_ready(done_ready),
      .out_pending(done_pending),
      .out_error(done_error),
      .out_sample(done_sample),
      .out_residual(trace_residual),
      .out_reference(trace_reference),
      .out_prediction(trace_prediction)
  );
  assign block_done = done_valid && done_ready;
  hmlfc_answer #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .MAX_DEPTH(MAX_DEPTH)
  ) answers (
      .clk,
      .rst_n,
      .depth(stream.depth),
      .chroma_444(stream.chroma_444),
      .in_valid(done_valid),
      .in_ready(done_ready),
      .in_job(done_pending.job),
      .in_error(done_error),
      .in_sample(done_sample),
      .chroma_spoiled,
      .out_valid(m_response_tvalid),
      .out_ready(m_response_tready),
      .out_data(m_response_tdata),
      .out_error(m_response_tuser),
      .out_last(m_response_tlast)
  );

  hmlfc_pkg::image_t done_image;
  hmlfc_images images (
      .clk,
      .write(image_write),
      .write_id({view_slot, image_level}),
      .write_image(view_image),
      .id_0(job.id),
      .id_1(motion_flow.job.id),
      .id_2(residual_flow.job.id),
      .id_3(done_pending.job.id),
      .image_0(ask_image),
      .image_1(disparity_image),
      .image_2(reference_image),
      .image_3(done_image)
  );

  assign trace_valid = block_done;
  assign trace_level = 4'(done_pending.job.id[2:0]);
  assign trace_plane = done_pending.job.plane;
  assign trace_bx = 15'(done_pending.job.bx);
  assign trace_by = 15'(done_pending.job.by);
  assign trace_row = 12'(done_image.row);
  assign trace_col = 12'(done_image.col);
  assign trace_key = done_pending.key;
  assign trace_motion = done_pending.motion;
  assign trace_negative = done_pending.negative;
  assign trace_references = !done_pending.motion ? 2'd0 : done_pending.two ? 2'd2 : 2'd1;
  assign trace_ix_a = done_pending.ix_a;
  assign trace_iy_a = done_pending.iy_a;
  assign trace_fx_a = done_pending.fx_a;
  assign trace_fy_a = done_pending.fy_a;
  assign trace_ix_b = done_pending.ix_b;
  assign trace_iy_b = done_pending.iy_b;
  assign trace_fx_b = done_pending.fx_b;
  assign trace_fy_b = done_pending.fy_b;
  assign trace_has_residual = done_pending.has_residual;
  assign trace_sample = done_sample;
  assign trace_error = done_error;

endmodule
