// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The rules of axi_*_assertions.sv at all pins of hmlfc_decode_unit, and at its queues, by bind.
module hmlfc_decode_unit_assertions #(
    parameter int BLOCK_LOG2 = 2,
    parameter int AXI_DATA_BITS = 128,
    parameter int OUTSTANDING = 64,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,
    input logic s_request_tvalid,
    input logic s_request_tready,
    input logic [63:0] s_request_tdata,
    input logic s_request_tlast,
    input logic m_response_tvalid,
    input logic m_response_tready,
    input logic [3*SAMPLES*16-1:0] m_response_tdata,
    input logic [5:0] m_response_tuser,
    input logic m_response_tlast,
    input logic m_axi_arvalid,
    input logic m_axi_arready,
    input logic [ADDRESS_BITS-1:0] m_axi_araddr,
    input logic [7:0] m_axi_arlen,
    input logic [2:0] m_axi_arsize,
    input logic [1:0] m_axi_arburst,
    input logic m_axi_rvalid,
    input logic m_axi_rready,
    input logic m_axi_rlast,
    input logic s_axil_awvalid,
    input logic s_axil_awready,
    input logic [11:0] s_axil_awaddr,
    input logic s_axil_wvalid,
    input logic s_axil_wready,
    input logic [31:0] s_axil_wdata,
    input logic [3:0] s_axil_wstrb,
    input logic s_axil_bvalid,
    input logic s_axil_bready,
    input logic [1:0] s_axil_bresp,
    input logic s_axil_arvalid,
    input logic s_axil_arready,
    input logic [11:0] s_axil_araddr,
    input logic s_axil_rvalid,
    input logic s_axil_rready,
    input logic [31:0] s_axil_rdata,
    input logic [1:0] s_axil_rresp
);
  axi_channel_assertions #(.NAME("s_request"), .BITS(65)) request (
      .clk, .rst_n, .valid(s_request_tvalid), .ready(s_request_tready), .payload({s_request_tlast, s_request_tdata}));
  axi_channel_assertions #(.NAME("m_response"), .BITS(3 * SAMPLES * 16 + 7)) response (
      .clk, .rst_n, .valid(m_response_tvalid), .ready(m_response_tready),
      .payload({m_response_tlast, m_response_tuser, m_response_tdata}));
  axi_read_assertions #(
      .NAME("m_axi"), .ADDRESS_BITS(ADDRESS_BITS), .DATA_BITS(AXI_DATA_BITS), .OUTSTANDING(OUTSTANDING + 1)
  ) reads (
      .clk, .rst_n, .arvalid(m_axi_arvalid), .arready(m_axi_arready), .araddr(m_axi_araddr), .arlen(m_axi_arlen),
      .arsize(m_axi_arsize), .arburst(m_axi_arburst), .rvalid(m_axi_rvalid), .rready(m_axi_rready),
      .rlast(m_axi_rlast));
  axi_lite_assertions #(.NAME("s_axil")) registers (
      .clk, .rst_n, .awvalid(s_axil_awvalid), .awready(s_axil_awready), .awaddr(s_axil_awaddr), .wvalid(s_axil_wvalid),
      .wready(s_axil_wready), .wdata(s_axil_wdata), .wstrb(s_axil_wstrb), .bvalid(s_axil_bvalid),
      .bready(s_axil_bready), .bresp(s_axil_bresp), .arvalid(s_axil_arvalid), .arready(s_axil_arready),
      .araddr(s_axil_araddr), .rvalid(s_axil_rvalid), .rready(s_axil_rready), .rdata(s_axil_rdata),
      .rresp(s_axil_rresp));
endmodule

bind hmlfc_decode_unit hmlfc_decode_unit_assertions #(
    .BLOCK_LOG2(BLOCK_LOG2), .AXI_DATA_BITS(AXI_DATA_BITS), .OUTSTANDING(OUTSTANDING)) protocol (.*);

// The same rules where blocks wait inside: at the ends of all queues and register slices.
bind hmlfc_fifo axi_channel_assertions #(.NAME("fifo"), .BITS(WIDTH)) waiting (
    .clk, .rst_n, .valid(out_valid), .ready(out_ready), .payload(out_data));
bind hmlfc_fifo hmlfc_fifo_assertions #(.DEPTH(DEPTH), .BYPASS(BYPASS)) rules (
    .clk, .rst_n, .in_valid, .in_ready, .out_valid, .out_ready);
bind hmlfc_skid_buffer axi_channel_assertions #(.NAME("skid_buffer"), .BITS(WIDTH)) waiting (
    .clk, .rst_n, .valid(out_valid), .ready(out_ready), .payload(out_data));

`default_nettype wire
