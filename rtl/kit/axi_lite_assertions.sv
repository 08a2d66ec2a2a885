// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// A subordinate of AXI4-Lite: one answer for each write and for each read, after both parts of it have come.
module axi_lite_assertions #(
    parameter string NAME = "AXI4-Lite",
    parameter int ADDRESS_BITS = 12
) (
    input logic clk,
    input logic rst_n,
    input logic awvalid,
    input logic awready,
    input logic [ADDRESS_BITS-1:0] awaddr,
    input logic wvalid,
    input logic wready,
    input logic [31:0] wdata,
    input logic [3:0] wstrb,
    input logic bvalid,
    input logic bready,
    input logic [1:0] bresp,
    input logic arvalid,
    input logic arready,
    input logic [ADDRESS_BITS-1:0] araddr,
    input logic rvalid,
    input logic rready,
    input logic [31:0] rdata,
    input logic [1:0] rresp
);
  axi_channel_assertions #(.NAME({NAME, ": write address"}), .BITS(ADDRESS_BITS)) aw (
      .clk, .rst_n, .valid(awvalid), .ready(awready), .payload(awaddr));
  axi_channel_assertions #(.NAME({NAME, ": write data"}), .BITS(36)) w (
      .clk, .rst_n, .valid(wvalid), .ready(wready), .payload({wstrb, wdata}));
  axi_channel_assertions #(.NAME({NAME, ": write response"}), .BITS(2)) b (
      .clk, .rst_n, .valid(bvalid), .ready(bready), .payload(bresp));
  axi_channel_assertions #(.NAME({NAME, ": read address"}), .BITS(ADDRESS_BITS)) ar (
      .clk, .rst_n, .valid(arvalid), .ready(arready), .payload(araddr));
  axi_channel_assertions #(.NAME({NAME, ": read data"}), .BITS(34)) r (
      .clk, .rst_n, .valid(rvalid), .ready(rready), .payload({rresp, rdata}));

  // Accepted and not answered.
  int unsigned addresses, data, reads;
  always_ff @(posedge clk) begin
    addresses <= addresses + 32'(awvalid && awready) - 32'(bvalid && bready);
    data <= data + 32'(wvalid && wready) - 32'(bvalid && bready);
    reads <= reads + 32'(arvalid && arready) - 32'(rvalid && rready);
    if (!rst_n) {addresses, data, reads} <= '0;
  end
  assert property (@(posedge clk) disable iff (!rst_n) bvalid |-> addresses != 0 && data != 0)
  else $error("%s: a write response without its write", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) rvalid |-> reads != 0)
  else $error("%s: read data without its address", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) bvalid |-> bresp != 2'b01)
  else $error("%s: a write response of EXOKAY", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) rvalid |-> rresp != 2'b01)
  else $error("%s: read data of EXOKAY", NAME);
endmodule

`default_nettype wire
