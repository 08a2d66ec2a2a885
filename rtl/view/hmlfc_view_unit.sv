// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Decodes rectangles of views to memory by itself: a decode unit, and what takes descriptors and writes its answers
// (docs/view_unit.md).
//
// One AXI4-Lite port: address bit 11 is 0 for the registers of the decode unit, 1 for those of the queue. One AXI4 read
// master: ID 0 for the decode unit, 1 for descriptors. One AXI4 write master, all with ID 0.
module hmlfc_view_unit #(
    parameter int BLOCK_LOG2 = 2,      // these are those of hmlfc_decode_unit
    parameter int MAX_DEPTH = 8,
    parameter int AXI_DATA_BITS = 128,
    parameter int OUTSTANDING = 64,
    parameter int TILE_CONTEXTS = 16,
    parameter int CACHES = 2,
    parameter int CACHE_STRIPS = 512,
    parameter int STRIP_READ = 32,
    parameter int BLOCK_CLOCKS = 1,
    parameter int TRACE = 1,
    parameter logic [2:0] AXI_PROT = 3'b010,
    parameter logic [3:0] AXI_CACHE = 4'b0011,
    parameter logic [3:0] AXI_QOS = 4'd0,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int SAMPLE_BITS = MAX_DEPTH + 1
) (
    input logic clk,
    input logic rst_n,

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

    output logic m_axi_awvalid,
    input logic m_axi_awready,
    output logic [ADDRESS_BITS-1:0] m_axi_awaddr,
    output logic [7:0] m_axi_awlen,
    output logic [2:0] m_axi_awsize,
    output logic [1:0] m_axi_awburst,
    output logic [0:0] m_axi_awid,
    output logic [2:0] m_axi_awprot,
    output logic [3:0] m_axi_awcache,
    output logic [3:0] m_axi_awqos,
    output logic m_axi_wvalid,
    input logic m_axi_wready,
    output logic [AXI_DATA_BITS-1:0] m_axi_wdata,
    output logic [AXI_DATA_BITS/8-1:0] m_axi_wstrb,
    output logic m_axi_wlast,
    input logic m_axi_bvalid,
    output logic m_axi_bready,
    input logic [1:0] m_axi_bresp,
    input logic [0:0] m_axi_bid,

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
    output logic irq,

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

  // ---- Registers.
  logic [1:0] awvalid, awready, wvalid, wready, bvalid, bready, arvalid, arready, rvalid, rready;
  logic [63:0] rdata;
  logic a_busy, resetting, unit_rst_n;
  hmlfc_axil_split split (
      .clk, .rst_n, .a_closed(resetting), .a_busy, .s_awvalid(s_axil_awvalid), .s_awready(s_axil_awready),
      .s_awaddr(s_axil_awaddr), .s_wvalid(s_axil_wvalid), .s_wready(s_axil_wready), .s_bvalid(s_axil_bvalid),
      .s_bready(s_axil_bready), .s_arvalid(s_axil_arvalid), .s_arready(s_axil_arready), .s_araddr(s_axil_araddr),
      .s_rvalid(s_axil_rvalid), .s_rready(s_axil_rready), .s_rdata(s_axil_rdata), .awvalid, .awready, .wvalid,
      .wready, .bvalid, .bready, .arvalid, .arready, .rvalid, .rready, .rdata
  );
  assign s_axil_bresp = 2'b00;
  assign s_axil_rresp = 2'b00;

  // ---- The read master: descriptors go first; what waits for the memory does not change.
  logic unit_arvalid, unit_arready, fetch_arvalid, ar_ready;
  wire read_valid = unit_rst_n && (fetch_arvalid || unit_arvalid);
  logic [ADDRESS_BITS-1:0] unit_araddr, fetch_araddr;
  logic [7:0] unit_arlen, fetch_arlen;
  hmlfc_skid_buffer #(.WIDTH(ADDRESS_BITS + 9)) addresses (
      .clk, .rst_n, .in_valid(read_valid), .in_ready(ar_ready),
      .in_data(fetch_arvalid ? {fetch_araddr, fetch_arlen, 1'b1} : {unit_araddr, unit_arlen, 1'b0}),
      .out_valid(m_axi_arvalid), .out_ready(m_axi_arready), .out_data({m_axi_araddr, m_axi_arlen, m_axi_arid})
  );
  assign unit_arready = ar_ready && !fetch_arvalid;
  assign m_axi_rready = 1'b1;
  assign m_axi_awid = 1'b0;
  assign {m_axi_awprot, m_axi_awcache, m_axi_awqos} = {AXI_PROT, AXI_CACHE, AXI_QOS};

  // ---- The decode unit.
  logic request_tvalid, request_tready, response_tvalid, response_tready;
  logic [63:0] request_tdata;
  logic [3*SAMPLES*16-1:0] response_tdata;
  logic [5:0] response_tuser;
  logic unit_active, dma_busy;
  hmlfc_decode_unit #(
      .BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .AXI_DATA_BITS(AXI_DATA_BITS), .OUTSTANDING(OUTSTANDING),
      .TILE_CONTEXTS(TILE_CONTEXTS), .CACHES(CACHES), .CACHE_STRIPS(CACHE_STRIPS), .STRIP_READ(STRIP_READ),
      .BLOCK_CLOCKS(BLOCK_CLOCKS), .TRACE(TRACE), .AXI_PROT(AXI_PROT), .AXI_CACHE(AXI_CACHE), .AXI_QOS(AXI_QOS)
  ) unit (
      .clk, .rst_n(unit_rst_n), .s_request_tvalid(request_tvalid), .s_request_tready(request_tready),
      .s_request_tdata(request_tdata), .s_request_tlast(1'b0), .m_response_tvalid(response_tvalid),
      .m_response_tready(response_tready), .m_response_tdata(response_tdata), .m_response_tuser(response_tuser),
      .m_response_tlast(), .m_axi_arvalid(unit_arvalid), .m_axi_arready(unit_arready), .m_axi_araddr(unit_araddr),
      .m_axi_arlen(unit_arlen), .m_axi_arsize, .m_axi_arburst, .m_axi_arid(), .m_axi_arprot, .m_axi_arcache,
      .m_axi_arqos, .m_axi_rvalid(m_axi_rvalid && !m_axi_rid), .m_axi_rready(), .m_axi_rdata, .m_axi_rresp,
      .m_axi_rlast, .m_axi_rid(1'b0), .s_axil_awvalid(awvalid[0]), .s_axil_awready(awready[0]), .s_axil_awaddr,
      .s_axil_wvalid(wvalid[0]), .s_axil_wready(wready[0]), .s_axil_wdata, .s_axil_wstrb, .s_axil_bvalid(bvalid[0]),
      .s_axil_bready(bready[0]), .s_axil_bresp(), .s_axil_arvalid(arvalid[0]), .s_axil_arready(arready[0]),
      .s_axil_araddr, .s_axil_rvalid(rvalid[0]), .s_axil_rready(rready[0]), .s_axil_rdata(rdata[31:0]),
      .s_axil_rresp(), .active(unit_active), .trace_valid, .trace_level, .trace_plane, .trace_bx, .trace_by,
      .trace_row, .trace_col, .trace_key, .trace_motion, .trace_negative, .trace_references, .trace_ix_a, .trace_iy_a,
      .trace_fx_a, .trace_fy_a, .trace_ix_b, .trace_iy_b, .trace_fx_b, .trace_fy_b, .trace_has_residual,
      .trace_residual, .trace_reference, .trace_prediction, .trace_sample, .trace_error
  );

  // ---- Views.
  hmlfc_view_dma #(.BLOCK_LOG2(BLOCK_LOG2), .AXI_DATA_BITS(AXI_DATA_BITS)) dma (
      .clk, .rst_n, .unit_rst_n, .resetting, .accessed(a_busy), .read_asked(read_valid && ar_ready),
      .read_ended(m_axi_rvalid && m_axi_rlast), .read_moves((m_axi_arvalid && m_axi_arready) || m_axi_rvalid),
      .m_request_tvalid(request_tvalid), .m_request_tready(request_tready), .m_request_tdata(request_tdata),
      .s_response_tvalid(response_tvalid), .s_response_tready(response_tready), .s_response_tdata(response_tdata),
      .s_response_tuser(response_tuser), .fetch_arvalid, .fetch_arready(ar_ready), .fetch_araddr, .fetch_arlen,
      .fetch_rvalid(m_axi_rvalid && m_axi_rid), .fetch_rdata(m_axi_rdata), .fetch_rresp(m_axi_rresp),
      .fetch_rlast(m_axi_rlast), .m_axi_awvalid, .m_axi_awready, .m_axi_awaddr, .m_axi_awlen, .m_axi_awsize,
      .m_axi_awburst, .m_axi_wvalid, .m_axi_wready, .m_axi_wdata, .m_axi_wstrb, .m_axi_wlast, .m_axi_bvalid,
      .m_axi_bready, .m_axi_bresp, .s_axil_awvalid(awvalid[1]), .s_axil_awready(awready[1]), .s_axil_awaddr,
      .s_axil_wvalid(wvalid[1]), .s_axil_wready(wready[1]), .s_axil_wdata, .s_axil_wstrb, .s_axil_bvalid(bvalid[1]),
      .s_axil_bready(bready[1]), .s_axil_arvalid(arvalid[1]), .s_axil_arready(arready[1]), .s_axil_araddr,
      .s_axil_rvalid(rvalid[1]), .s_axil_rready(rready[1]), .s_axil_rdata(rdata[63:32]), .irq, .busy(dma_busy)
  );

  // ---- Whether the clock is needed. An access to a register is under way in one of the two.
  hmlfc_activity #(.CHANNELS(5), .PARTS(2)) activity (
      .clk, .rst_n, .offered({m_axi_rvalid, m_axi_bvalid, s_axil_awvalid, s_axil_wvalid, s_axil_arvalid}),
      .busy({unit_active, dma_busy}), .active
  );

endmodule

`default_nettype wire
