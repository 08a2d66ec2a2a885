// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// A small system around the view unit, for simulation: memory, interrupt, and a bus master that runs the C driver
// (soc_main.c).
//
// There is no processor in it: the program is compiled for the host and called through DPI-C, one step a clock. Its
// accesses to registers are real ones, through AXI4-Lite. The memory's bytes are the program's, so that both see the
// same ones; the unit reaches them through AXI4 alone.
//
// Plusargs: +stream=FILE +row=R +col=C +out=FILE.ppm. Ends with status 1 where the program returns another value than
// 0.
module soc #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8
);
  localparam int BITS = 128;
  localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS;

  // Begins the program.
  import "DPI-C" function void soc_start(
      input string stream,
      input int row,
      input int col,
      input string out
  );
  // Runs it until it wants something: 0, that a clock passes; a register read or written; or to end with the result
  // write_data.
  import "DPI-C" function int soc_step(
      input bit irq,
      input bit [31:0] read_data,
      output bit [11:0] address,
      output bit [31:0] write_data
  );
  localparam int READ = 1;
  localparam int WRITE = 2;
  localparam int END = 3;

  logic clk;
  initial begin
    clk = 0;
    forever #5 clk = ~clk;
  end
  longint clocks = 0;
  logic rst_n;
  assign rst_n = clocks > 3;
  always_ff @(posedge clk) clocks <= clocks + 1;

  // ---- The unit and its memory.
  logic arvalid, arready, rvalid, rready, rlast, awvalid, awready, wvalid, wready, wlast, bvalid, bready;
  logic [ADDRESS_BITS-1:0] araddr, awaddr;
  logic [7:0] arlen;
  logic [0:0] arid, rid;
  logic [BITS-1:0] rdata, wdata;
  logic [BITS/8-1:0] wstrb;

  logic lite_awvalid, lite_awready, lite_wvalid, lite_wready, lite_bvalid, lite_bready;
  logic lite_arvalid, lite_arready, lite_rvalid, lite_rready;
  logic [11:0] lite_addr;
  logic [31:0] lite_wdata, lite_rdata;
  logic irq;

  /* verilator lint_off PINCONNECTEMPTY */
  hmlfc_view_unit #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .MAX_DEPTH(MAX_DEPTH),
      .AXI_DATA_BITS(BITS),
      .TRACE(0)
  ) unit (
      .clk,
      .rst_n,
      .m_axi_arvalid(arvalid),
      .m_axi_arready(arready),
      .m_axi_araddr(araddr),
      .m_axi_arlen(arlen),
      .m_axi_arsize(),
      .m_axi_arburst(),
      .m_axi_arid(arid),
      .m_axi_arprot(),
      .m_axi_arcache(),
      .m_axi_arqos(),
      .m_axi_rvalid(rvalid),
      .m_axi_rready(rready),
      .m_axi_rdata(rdata),
      .m_axi_rresp(2'b00),
      .m_axi_rlast(rlast),
      .m_axi_rid(rid),
      .m_axi_awvalid(awvalid),
      .m_axi_awready(awready),
      .m_axi_awaddr(awaddr),
      .m_axi_awlen(),
      .m_axi_awsize(),
      .m_axi_awburst(),
      .m_axi_awid(),
      .m_axi_awprot(),
      .m_axi_awcache(),
      .m_axi_awqos(),
      .m_axi_wvalid(wvalid),
      .m_axi_wready(wready),
      .m_axi_wdata(wdata),
      .m_axi_wstrb(wstrb),
      .m_axi_wlast(wlast),
      .m_axi_bvalid(bvalid),
      .m_axi_bready(bready),
      .m_axi_bresp(2'b00),
      .m_axi_bid(1'b0),
      .s_axil_awvalid(lite_awvalid),
      .s_axil_awready(lite_awready),
      .s_axil_awaddr(lite_addr),
      .s_axil_wvalid(lite_wvalid),
      .s_axil_wready(lite_wready),
      .s_axil_wdata(lite_wdata),
      .s_axil_wstrb(4'b1111),
      .s_axil_bvalid(lite_bvalid),
      .s_axil_bready(lite_bready),
      .s_axil_bresp(),
      .s_axil_arvalid(lite_arvalid),
      .s_axil_arready(lite_arready),
      .s_axil_araddr(lite_addr),
      .s_axil_rvalid(lite_rvalid),
      .s_axil_rready(lite_rready),
      .s_axil_rdata(lite_rdata),
      .s_axil_rresp(),
      .irq,
      .active(),
      .trace_valid(),
      .trace_level(),
      .trace_plane(),
      .trace_bx(),
      .trace_by(),
      .trace_row(),
      .trace_col(),
      .trace_key(),
      .trace_motion(),
      .trace_negative(),
      .trace_references(),
      .trace_ix_a(),
      .trace_iy_a(),
      .trace_fx_a(),
      .trace_fy_a(),
      .trace_ix_b(),
      .trace_iy_b(),
      .trace_fx_b(),
      .trace_fy_b(),
      .trace_has_residual(),
      .trace_residual(),
      .trace_reference(),
      .trace_prediction(),
      .trace_sample(),
      .trace_error()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  soc_memory #(
      .BITS(BITS),
      .ADDRESS_BITS(ADDRESS_BITS)
  ) memory (
      .clk,
      .rst_n,
      .arvalid,
      .arready,
      .araddr,
      .arlen,
      .arid,
      .rvalid,
      .rready,
      .rdata,
      .rlast,
      .rid,
      .awvalid,
      .awready,
      .awaddr,
      .wvalid,
      .wready,
      .wdata,
      .wstrb,
      .wlast,
      .bvalid,
      .bready
  );

  // ---- The bus master: one access at a time.
  bit [11:0] address;
  bit [31:0] write_data, read_data;
  int kind;
  always_ff @(posedge clk) begin
    if (lite_awready) lite_awvalid <= 0;
    if (lite_wready) lite_wvalid <= 0;
    if (lite_bvalid) lite_bready <= 0;
    if (lite_arready) lite_arvalid <= 0;
    if (lite_rvalid && lite_rready) begin
      lite_rready <= 0;
      read_data <= lite_rdata;
    end
    if (!rst_n) begin
      {lite_awvalid, lite_wvalid, lite_bready, lite_arvalid, lite_rready} <= 0;
    end else if (!lite_bready && !lite_rready) begin
      /* verilator lint_off BLKSEQ */  // a call in the clock in which its result is used
      kind = soc_step(irq, read_data, address, write_data);
      /* verilator lint_on BLKSEQ */
      lite_addr <= address;
      lite_wdata <= write_data;
      if (kind == READ) {lite_arvalid, lite_rready} <= 2'b11;
      if (kind == WRITE) {lite_awvalid, lite_wvalid, lite_bready} <= 3'b111;
      if (kind == END) begin
        $display("soc: %0d clocks", clocks);
        if (write_data != 0) $fatal(1, "soc: the program returned %0d", write_data);
        $finish;
      end
    end
  end

  string stream, out;
  int row, col;
  initial begin
    row = 0;
    col = 0;
    if ($value$plusargs("stream=%s", stream) == 0) $fatal(1, "soc: +stream=FILE is missing");
    if ($value$plusargs("out=%s", out) == 0) out = "";
    void'($value$plusargs("row=%d", row));
    void'($value$plusargs("col=%d", col));
    soc_start(stream, row, col, out);
  end
endmodule

`default_nettype wire
