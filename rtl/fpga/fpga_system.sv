// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The view unit, a memory of block RAM, and a serial port through which a host reaches both (fpga_commands.sv).
//
// SIZE_LOG2        bytes of the memory, as a power of two
// CLOCKS_PER_BIT   >= 4, of the serial port
// BLOCK_LOG2       of the unit; its other parameters are its smallest
//
// `rst_n` is synchronous. `led`: 0 the unit needs its clock, 1 its interrupt, 2 and 3 the host sends and receives.
module fpga_system #(
    parameter int SIZE_LOG2 = 16,
    parameter int CLOCKS_PER_BIT = 25,
    parameter int BLOCK_LOG2 = 2
) (
    input logic clk,
    input logic rst_n,
    input logic rx,
    output logic tx,
    output logic [3:0] led
);
  localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS;

  logic in_valid, out_valid, out_ready, byte_read, byte_write;
  logic [7:0] in_data, out_data, byte_wdata, byte_rdata;
  logic [SIZE_LOG2-1:0] byte_address;
  logic lite_awvalid, lite_awready, lite_wvalid, lite_wready, lite_bvalid;
  logic lite_arvalid, lite_arready, lite_rvalid;
  logic [11:0] lite_address;
  logic [31:0] lite_wdata, lite_rdata;
  logic arvalid, arready, arid, rvalid, rlast, rid, awvalid, awready, wvalid, wready, wlast, bvalid, bready;
  logic [ADDRESS_BITS-1:0] araddr, awaddr;
  logic [7:0] arlen, wstrb;
  logic [63:0] rdata, wdata;
  logic active, irq;

  fpga_serial #(.CLOCKS_PER_BIT(CLOCKS_PER_BIT)) serial (
      .clk, .rst_n, .rx, .tx, .in_valid, .in_data, .out_valid, .out_ready, .out_data
  );
  fpga_commands #(.SIZE_LOG2(SIZE_LOG2)) commands (
      .clk, .rst_n, .in_valid, .in_data, .out_valid, .out_ready, .out_data, .mem_read(byte_read),
      .mem_write(byte_write), .mem_address(byte_address), .mem_wdata(byte_wdata), .mem_rdata(byte_rdata),
      .lite_awvalid, .lite_awready, .lite_wvalid, .lite_wready, .lite_bvalid, .lite_arvalid, .lite_arready,
      .lite_rvalid, .lite_address, .lite_wdata, .lite_rdata
  );
  fpga_memory #(.SIZE_LOG2(SIZE_LOG2)) memory (
      .clk, .rst_n, .arvalid, .arready, .araddr, .arlen, .arid, .rvalid, .rdata, .rlast, .rid,
      .awvalid, .awready, .awaddr, .wvalid, .wready, .wdata, .wstrb, .wlast, .bvalid, .bready,
      .byte_read, .byte_write, .byte_address, .byte_wdata, .byte_rdata
  );

  /* verilator lint_off PINMISSING */  // outputs that nothing here needs
  hmlfc_view_unit #(
      .BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(8), .AXI_DATA_BITS(64), .OUTSTANDING(4), .TILE_CONTEXTS(2),
      .CACHES(1), .CACHE_STRIPS(64), .BLOCK_CLOCKS(BLOCK_LOG2 == 1 ? 2 : 4), .TRACE(0)
  ) unit (
      .clk, .rst_n, .m_axi_arvalid(arvalid), .m_axi_arready(arready), .m_axi_araddr(araddr), .m_axi_arlen(arlen),
      .m_axi_arid(arid), .m_axi_rvalid(rvalid), .m_axi_rdata(rdata), .m_axi_rresp(2'b00), .m_axi_rlast(rlast),
      .m_axi_rid(rid), .m_axi_awvalid(awvalid), .m_axi_awready(awready), .m_axi_awaddr(awaddr),
      .m_axi_wvalid(wvalid), .m_axi_wready(wready), .m_axi_wdata(wdata), .m_axi_wstrb(wstrb), .m_axi_wlast(wlast),
      .m_axi_bvalid(bvalid), .m_axi_bready(bready), .m_axi_bresp(2'b00), .m_axi_bid(1'b0),
      .s_axil_awvalid(lite_awvalid), .s_axil_awready(lite_awready), .s_axil_awaddr(lite_address),
      .s_axil_wvalid(lite_wvalid), .s_axil_wready(lite_wready), .s_axil_wdata(lite_wdata), .s_axil_wstrb(4'b1111),
      .s_axil_bvalid(lite_bvalid), .s_axil_bready(1'b1), .s_axil_arvalid(lite_arvalid),
      .s_axil_arready(lite_arready), .s_axil_araddr(lite_address), .s_axil_rvalid(lite_rvalid), .s_axil_rready(1'b1),
      .s_axil_rdata(lite_rdata), .irq, .active
  );
  /* verilator lint_on PINMISSING */
  assign led = {!rx, !tx, irq, active};
endmodule

`default_nettype wire
