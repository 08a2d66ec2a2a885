// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Lines of memory on their way to hmlfc_write_port: each has a strobe.
module hmlfc_line_assertions #(
    parameter string NAME = "lines"
) (
    input logic clk,
    input logic rst_n,
    input logic line_valid,
    input logic [63:0] line_strobe
);
  assert property (@(posedge clk) disable iff (!rst_n) line_valid |-> line_strobe != 0)
  else $error("%s: a line without a strobe", NAME);
endmodule

`default_nettype wire
