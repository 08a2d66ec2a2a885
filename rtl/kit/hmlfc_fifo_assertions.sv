// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// What a hmlfc_fifo offers and takes, by a count of its own: it takes words until it has DEPTH, neither more nor fewer,
// and offers one while it has any, but without BYPASS not the one that was put in last clock.
module hmlfc_fifo_assertions #(
    parameter int DEPTH = 4,
    parameter bit BYPASS = 1
) (
    input logic clk,
    input logic rst_n,
    input logic in_valid,
    input logic in_ready,
    input logic out_valid,
    input logic out_ready
);
  int unsigned words, latest;
  always_ff @(posedge clk) begin
    latest <= BYPASS ? 0 : 32'(in_valid && in_ready);
    words <= rst_n ? words + 32'(in_valid && in_ready) - 32'(out_valid && out_ready) : 0;
  end
  assert property (@(posedge clk) disable iff (!rst_n) in_ready == (words < DEPTH))
  else $error("fifo: it has not room for DEPTH words");
  assert property (@(posedge clk) disable iff (!rst_n) out_valid == (words > latest))
  else $error("fifo: a word is not offered, or none is");
endmodule

`default_nettype wire
