// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Says when a unit needs its clock: outside, the clock may be stopped while `active` is low.
//
// `active` is high in each clock whose rising edge may change what the unit does: in reset, which is taken
// synchronously, and the clock after it; with a `valid` of a channel that the unit takes from (`offered`); while
// something is under way (`busy`). No register lies between: what wakes the unit is taken at the next rising edge.
module hmlfc_activity #(
    parameter int CHANNELS = 1,
    parameter int PARTS = 1
) (
    input logic clk,
    input logic rst_n,
    input logic [CHANNELS-1:0] offered,
    input logic [PARTS-1:0] busy,
    output logic active
);
  logic begins;  // the clock after a reset
  always_ff @(posedge clk) begins <= !rst_n;
  assign active = !rst_n || begins || offered != 0 || busy != 0;
endmodule

`default_nettype wire
