// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// All of hmlfc_view_unit but the decode unit: takes descriptors, asks for the blocks of their rectangles, and writes
// the answers to memory.
//
// `m_request_*` and `s_response_*` are the channels of the decode unit, which must have the same BLOCK_LOG2. `fetch_*`
// reads descriptors: bursts do not cross 4 KiB. `busy`: a descriptor or an access to a register is under way, a
// response is to come, or `irq` changes.
// `unit_rst_n` resets what software resets (hmlfc_view_guard): the decode unit, and all of this but the registers'
// port and the write master, which ends what it has begun. `accessed`: an access to the decode unit's registers is
// under way, of which none may begin while `resetting`. `read_*`: of all bursts of the read master.
module hmlfc_view_dma #(
    parameter int BLOCK_LOG2 = 2,  // 1..3
    parameter int AXI_DATA_BITS = 128,  // 64, 128
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,
    output logic unit_rst_n,
    output logic resetting,
    input logic accessed,
    input logic read_asked,
    input logic read_ended,
    input logic read_moves,

    output logic m_request_tvalid,
    input logic m_request_tready,
    output logic [63:0] m_request_tdata,
    input logic s_response_tvalid,
    output logic s_response_tready,
    input logic [3*SAMPLES*16-1:0] s_response_tdata,
    input logic [5:0] s_response_tuser,

    output logic fetch_arvalid,
    input logic fetch_arready,
    output logic [ADDRESS_BITS-1:0] fetch_araddr,
    output logic [7:0] fetch_arlen,
    input logic fetch_rvalid,
    input logic [AXI_DATA_BITS-1:0] fetch_rdata,
    input logic [1:0] fetch_rresp,
    input logic fetch_rlast,

    output logic m_axi_awvalid,
    input logic m_axi_awready,
    output logic [ADDRESS_BITS-1:0] m_axi_awaddr,
    output logic [7:0] m_axi_awlen,
    output logic [2:0] m_axi_awsize,
    output logic [1:0] m_axi_awburst,
    output logic m_axi_wvalid,
    input logic m_axi_wready,
    output logic [AXI_DATA_BITS-1:0] m_axi_wdata,
    output logic [AXI_DATA_BITS/8-1:0] m_axi_wstrb,
    output logic m_axi_wlast,
    input logic m_axi_bvalid,
    output logic m_axi_bready,
    input logic [1:0] m_axi_bresp,

    input logic s_axil_awvalid,
    output logic s_axil_awready,
    input logic [11:0] s_axil_awaddr,
    input logic s_axil_wvalid,
    output logic s_axil_wready,
    input logic [31:0] s_axil_wdata,
    input logic [3:0] s_axil_wstrb,
    output logic s_axil_bvalid,
    input logic s_axil_bready,
    input logic s_axil_arvalid,
    output logic s_axil_arready,
    input logic [11:0] s_axil_araddr,
    output logic s_axil_rvalid,
    input logic s_axil_rready,
    output logic [31:0] s_axil_rdata,
    output logic irq,
    output logic busy
);

  localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS;
  localparam int LANE_BITS = 16 << (2 * BLOCK_LOG2);

  // ---- Registers.
  logic enable, disable_queue, drain, abort_view;
  logic [ADDRESS_BITS-1:0] ring_base, status_base;
  logic [15:0] ring_size, producer, consumer;
  logic [5:0] status;
  logic [3:0] events;
  logic irq_changes, queue_busy, reset_unit, hung, was_hung;
  logic [23:0] watchdog;
  always_ff @(posedge clk) was_hung <= rst_n && hung;
  hmlfc_view_registers registers (
      .clk, .rst_n, .s_axil_awvalid, .s_axil_awready, .s_axil_awaddr, .s_axil_wvalid, .s_axil_wready, .s_axil_wdata,
      .s_axil_wstrb, .s_axil_bvalid, .s_axil_bready, .s_axil_arvalid, .s_axil_arready, .s_axil_araddr, .s_axil_rvalid,
      .s_axil_rready, .s_axil_rdata, .enable, .disable_queue, .drain, .abort_view, .reset_unit, .resetting, .watchdog,
      .ring_base, .status_base, .ring_size, .producer, .consumer, .status({hung, resetting, status}),
      .events({hung && !was_hung, events}), .irq, .irq_changes
  );

  // ---- Reset by software, and a memory that does not answer.
  logic port_idle;
  hmlfc_view_guard guard (
      .clk, .rst_n, .reset_unit, .accessed, .resetting, .unit_rst_n, .read_asked, .read_ended, .writes_idle(port_idle),
      .moves(read_moves || (m_axi_awvalid && m_axi_awready) || (m_axi_wvalid && m_axi_wready) || m_axi_bvalid),
      .watchdog, .hung
  );

  // ---- Descriptors: read ahead, asked for, answered.
  hmlfc_pkg::view_t next, view;  // whose blocks are asked for, whose blocks are written
  logic fetch_enable, fetching, fetch_busy, next_valid, next_take, asking, ask_start, ask, ask_valid, strip_ask_valid;
  logic [15:0] begun;
  hmlfc_view_fetch #(.BLOCK_LOG2(BLOCK_LOG2), .DATA_BITS(AXI_DATA_BITS)) fetch (
      .clk, .rst_n(unit_rst_n), .enable(fetch_enable), .ring_base, .ring_size, .producer, .begun, .holds(asking),
      .reading(fetching), .busy(fetch_busy), .valid(next_valid), .take(next_take), .view(next),
      .ar_valid(fetch_arvalid), .ar_ready(fetch_arready), .ar_address(fetch_araddr), .ar_len(fetch_arlen),
      .r_valid(fetch_rvalid), .r_data(fetch_rdata), .r_error(fetch_rresp[1]), .r_last(fetch_rlast)
  );

  logic view_start, answering, placed, block_error, flush, empty, status_valid, write_answered, write_failed;
  logic port_ready, port_valid;
  logic [1:0] status_kind, answered_kind;
  logic [5:0] error;
  logic [ADDRESS_BITS-7:0] status_line;
  logic [511:0] status_data;
  logic [63:0] status_strobe;
  logic strip_waits;  // a strip is asked for in part
  hmlfc_view_queue queue (
      .clk, .rst_n(unit_rst_n), .enable, .disable_queue, .drain, .abort_view, .status_base, .ring_size, .producer,
      .consumer, .status, .events, .busy(queue_busy), .fetch_enable, .begun, .fetching, .next_valid, .next,
      .next_take, .asking, .ask_start, .ask, .request_ready(m_request_tready),
      .request_waits((m_request_tvalid && !m_request_tready) || strip_waits),
      .asked_all(next.residuals ? !strip_ask_valid : !ask_valid), .asked(m_request_tvalid && m_request_tready),
      .answered(s_response_tvalid && s_response_tready), .view, .view_start, .answering, .placed, .block_error, .error,
      .flush, .empty, .data_written(port_valid && port_ready && !status_valid), .line_valid(status_valid),
      .line_ready(port_ready), .line(status_line), .line_data(status_data), .line_strobe(status_strobe),
      .line_kind(status_kind), .write_answered, .answered_kind, .write_failed
  );

  // ---- Requests.
  logic ask_block;
  logic [BLOCK_BITS-1:0] bx, by;
  hmlfc_view_scan scan (
      .clk, .rst_n(unit_rst_n), .start(ask_start), .blocks(next.blocks), .valid(ask_valid),
      .advance(ask && !next.residuals && (!ask_block || m_request_tready)), .has_block(ask_block), .bx, .by,
      .tile_ends(), .macro_ends()
  );
  logic strip_asked;
  logic [BLOCK_BITS-1:0] strip_bx, strip_by;
  hmlfc_strip_scan #(.BLOCK_LOG2(BLOCK_LOG2)) strip_scan (
      .clk, .rst_n(unit_rst_n), .start(ask_start), .view(next), .valid(strip_ask_valid),
      .advance(ask && next.residuals && m_request_tready), .bx(strip_bx), .by(strip_by), .strip_begins(),
      .strip_ends(strip_asked), .address()
  );
  assign strip_waits = next.residuals && strip_ask_valid && !(m_request_tready && strip_asked);
  assign m_request_tvalid = ask && (next.residuals ? strip_ask_valid : ask_valid && ask_block);
  assign m_request_tdata = {
    3'd0, next.residuals, next.stop_level, next.format[2] ? 2'd3 : next.format[1:0],
    2'd0, next.residuals ? strip_by : by, 2'd0, next.residuals ? strip_bx : bx, next.col, next.row
  };

  // ---- Answers.
  logic place_valid, place_ready, writer_empty, line_valid, block_placed, block_answer_ready, pixel_error;
  logic [5:0] pixel_status;
  hmlfc_pkg::place_t place;
  logic [ADDRESS_BITS-7:0] line;
  logic [511:0] line_data;
  logic [63:0] line_strobe;
  logic strip_placed, strip_answer_ready, strip_empty, strip_error, strip_line_valid;
  logic [ADDRESS_BITS-7:0] strip_line;
  logic [511:0] strip_line_data;
  logic [63:0] strip_line_strobe;
  hmlfc_view_place #(.BLOCK_LOG2(BLOCK_LOG2)) places (
      .clk, .rst_n(unit_rst_n), .start(view_start), .view, .done(block_placed), .place_valid, .place_ready, .place
  );
  hmlfc_view_writer #(.BLOCK_LOG2(BLOCK_LOG2)) writer (
      .clk, .rst_n(unit_rst_n), .view, .flush, .empty(writer_empty), .block_error(pixel_error), .error(pixel_status),
      .place_valid(answering && place_valid && !view.residuals), .place_ready, .place, .answer_valid(s_response_tvalid),
      .answer_ready(block_answer_ready), .answer(s_response_tdata), .answer_status(s_response_tuser), .line_valid,
      .line_ready(port_ready && !status_valid && !strip_line_valid), .line, .line_data, .line_strobe
  );
  hmlfc_strip_writer #(.BLOCK_LOG2(BLOCK_LOG2)) strips (
      .clk, .rst_n(unit_rst_n), .start(view_start), .view, .done(strip_placed), .flush, .empty(strip_empty),
      .block_error(strip_error), .answer_valid(answering && s_response_tvalid), .answer_ready(strip_answer_ready),
      .answer(s_response_tdata[0+:LANE_BITS]), .answer_status(s_response_tuser), .line_valid(strip_line_valid),
      .line_ready(port_ready && !status_valid), .line(strip_line), .line_data(strip_line_data),
      .line_strobe(strip_line_strobe)
  );
  assign s_response_tready = answering && view.residuals ? strip_answer_ready : block_answer_ready;
  assign placed = view.residuals ? strip_placed : block_placed;
  assign block_error = view.residuals ? strip_error : pixel_error;
  assign error = view.residuals ? s_response_tuser : pixel_status;
  assign port_valid = unit_rst_n && (line_valid || strip_line_valid || status_valid);
  hmlfc_write_port #(.DATA_BITS(AXI_DATA_BITS)) port (
      .clk, .rst_n, .line_valid(port_valid), .line_ready(port_ready),
      .line(status_valid ? status_line : strip_line_valid ? strip_line : line),
      .line_data(status_valid ? status_data : strip_line_valid ? strip_line_data : line_data),
      .line_strobe(status_valid ? status_strobe : strip_line_valid ? strip_line_strobe : line_strobe),
      .line_kind(status_valid ? status_kind : 2'd0), .idle(port_idle), .answered(write_answered), .answered_kind,
      .failed(write_failed), .m_axi_awvalid, .m_axi_awready, .m_axi_awaddr, .m_axi_awlen, .m_axi_awsize,
      .m_axi_awburst, .m_axi_wvalid, .m_axi_wready, .m_axi_wdata, .m_axi_wstrb, .m_axi_wlast, .m_axi_bvalid,
      .m_axi_bready, .m_axi_bresp
  );
  assign empty = writer_empty && strip_empty;
  wire register_accessed = !s_axil_awready || !s_axil_wready || s_axil_bvalid || s_axil_rvalid;
  assign busy = queue_busy || fetch_busy || !port_idle || register_accessed || irq_changes || resetting;

endmodule

`default_nettype wire
