// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Reads of AXI4 with one ID: beats come in the order of the bursts.
//
// DATA_BITS     width of a beat
// MAX_BEATS     [1, 256], of a burst
// OUTSTANDING   bursts in flight
module axi_read_assertions #(
    parameter string NAME = "read master",
    parameter int ADDRESS_BITS = 40,
    parameter int DATA_BITS = 128,
    parameter int MAX_BEATS = 16,
    parameter int OUTSTANDING = 64
) (
    input logic clk,
    input logic rst_n,
    input logic arvalid,
    input logic arready,
    input logic [ADDRESS_BITS-1:0] araddr,
    input logic [7:0] arlen,
    input logic [2:0] arsize,
    input logic [1:0] arburst,
    input logic rvalid,
    input logic rready,
    input logic rlast
);
  localparam int BEAT_LOG2 = $clog2(DATA_BITS / 8);
  axi_channel_assertions #(
      .NAME({NAME, ": address"}),
      .BITS(ADDRESS_BITS + 13)
  ) address (
      .clk,
      .rst_n,
      .valid(arvalid),
      .ready(arready),
      .payload({araddr, arlen, arsize, arburst})
  );
  assert property (@(posedge clk) disable iff (!rst_n) arvalid |-> 32'(arlen) < MAX_BEATS)
  else $error("%s: a burst of more than MAX_BEATS", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) arvalid |-> arburst == 2'b01 && arsize == 3'(BEAT_LOG2))
  else $error("%s: not INCR, or not of whole beats", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) arvalid |-> araddr[BEAT_LOG2-1:0] == '0)
  else $error("%s: the address is not that of a beat", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) arvalid |->
      32'(araddr[11:BEAT_LOG2]) + 32'(arlen) < 4096 / (DATA_BITS / 8))
  else $error("%s: a burst crosses 4 KiB", NAME);

  // Bursts in flight: their lengths, the oldest at the front.
  logic [7:0] lengths[OUTSTANDING];
  logic [7:0] beat;
  int unsigned head, count;
  wire [7:0] length = lengths[head];
  wire takes = arvalid && arready;
  wire ends = rvalid && rready && rlast && count != 0;
  always_ff @(posedge clk) begin
    if (takes) lengths[(head+count)%OUTSTANDING] <= arlen;
    if (rvalid && rready) beat <= rlast ? '0 : beat + 8'd1;
    if (ends) head <= (head + 1) % OUTSTANDING;
    count <= count + 32'(takes) - 32'(ends);
    if (!rst_n) {head, count, beat} <= '0;
  end
  assert property (@(posedge clk) disable iff (!rst_n) takes |-> count < OUTSTANDING)
  else $error("%s: more than OUTSTANDING bursts", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) rvalid && count != 0 |-> rlast == (beat == length))
  else $error("%s: rlast is not at the burst's last beat", NAME);
endmodule

`default_nettype wire
