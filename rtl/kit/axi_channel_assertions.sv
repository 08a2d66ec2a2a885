// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// A channel of AXI4, AXI4-Lite or AXI4-Stream as concurrent assertions, for any simulator: what waits stays and does
// not change; nothing is offered in the clock after a reset. Instantiate it at a channel's pins, or bind it.
//
// That valid does not wait for ready cannot be seen in one run; rtl/formal proves it of the decode unit's ends.
//
// NAME   for messages
// BITS   of the payload: everything that the source gives with valid
module axi_channel_assertions #(
    parameter string NAME = "channel",
    parameter int BITS = 1
) (
    input logic clk,
    input logic rst_n,
    input logic valid,
    input logic ready,
    input logic [BITS-1:0] payload
);
  assert property (@(posedge clk) disable iff (!rst_n) valid && !ready |=> valid)
  else $error("%s: valid falls before ready", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) valid && !ready |=> $stable(payload))
  else $error("%s: the payload changes while it waits", NAME);
  assert property (@(posedge clk) !rst_n |=> !valid)
  else $error("%s: valid after reset", NAME);
  assert property (@(posedge clk) disable iff (!rst_n) !$isunknown({valid, ready}))
  else $error("%s: the handshake is unknown", NAME);
endmodule

`default_nettype wire
