// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Writes of AXI4 with one ID. Data may pass before their address.
//
// DATA_BITS     width of a beat
// MAX_BEATS     [1, 256], of a burst
// OUTSTANDING   bursts without response
module axi_write_assertions #(
    parameter string NAME = "write master",
    parameter int ADDRESS_BITS = 40,
    parameter int DATA_BITS = 128,
    parameter int MAX_BEATS = 16,
    parameter int OUTSTANDING = 16
) (
    input logic clk,
    input logic rst_n,
    input logic awvalid,
    input logic awready,
    input logic [ADDRESS_BITS-1:0] awaddr,
    input logic [7:0] awlen,
    input logic [2:0] awsize,
    input logic [1:0] awburst,
    input logic wvalid,
    input logic wready,
    input logic [DATA_BITS-1:0] wdata,
    input logic [DATA_BITS/8-1:0] wstrb,
    input logic wlast,
    input logic bvalid,
    input logic bready,
    input logic [1:0] bresp
);
  localparam int BEAT_LOG2 = $clog2(DATA_BITS / 8);
  axi_channel_assertions #(
      .NAME({NAME, ": address"}),
      .BITS(ADDRESS_BITS + 13)
  ) address (
      .clk,
      .rst_n,
      .valid(awvalid),
      .ready(awready),
      .payload({awaddr, awlen, awsize, awburst})
  );
  axi_channel_assertions #(
      .NAME({NAME, ": data"}),
      .BITS(DATA_BITS + DATA_BITS / 8 + 1)
  ) beats (
      .clk,
      .rst_n,
      .valid(wvalid),
      .ready(wready),
      .payload({wdata, wstrb, wlast})
  );
  assert property (@(posedge clk) disable iff (!rst_n) awvalid |-> 32'(awlen) < MAX_BEATS)
  else $error("%s: a burst of more than MAX_BEATS", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) awvalid |-> awburst == 2'b01 && awsize == 3'(BEAT_LOG2))
  else $error("%s: not INCR, or not of whole beats", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) awvalid |-> awaddr[BEAT_LOG2-1:0] == '0)
  else $error("%s: the address is not that of a beat", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) awvalid |->
      32'(awaddr[11:BEAT_LOG2]) + 32'(awlen) < 4096 / (DATA_BITS / 8))
  else $error("%s: a burst crosses 4 KiB", NAME);

  // Bursts by addresses and by data since the last response to all of them, and those that have their response.
  logic [7:0] lengths[2*OUTSTANDING];
  logic [7:0] sent[2*OUTSTANDING];
  logic [7:0] beat;
  int unsigned addressed, completed, answered, compared;
  wire takes = awvalid && awready;
  wire ends = wvalid && wready && wlast;
  wire [7:0] length = lengths[compared%(2*OUTSTANDING)];
  wire [7:0] last_sent = sent[compared%(2*OUTSTANDING)];
  wire both = compared != addressed && compared != completed;
  always_ff @(posedge clk) begin
    if (takes) lengths[addressed%(2*OUTSTANDING)] <= awlen;
    if (ends) sent[completed%(2*OUTSTANDING)] <= beat;
    if (wvalid && wready) beat <= wlast ? '0 : beat + 8'd1;
    addressed <= addressed + 32'(takes);
    completed <= completed + 32'(ends);
    answered <= answered + 32'(bvalid && bready);
    if (both) compared <= compared + 1;
    if (!rst_n) {addressed, completed, answered, compared, beat} <= '0;
  end
  assert property (@(posedge clk) disable iff (!rst_n) takes |-> addressed - answered < OUTSTANDING)
  else $error("%s: more than OUTSTANDING bursts", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) both |-> length == last_sent)
  else $error("%s: wlast is not at the burst's last beat", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) bvalid |-> answered != addressed && answered != completed)
  else $error("%s: a response without its burst", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) bvalid |-> bresp != 2'b01)
  else $error("%s: EXOKAY", NAME);
endmodule

`default_nettype wire
