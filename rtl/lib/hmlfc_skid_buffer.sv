// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// A register slice that cuts both paths of a handshake: all outputs come from registers.
//
// WIDTH   >= 1, bits of a word
//
// A word passes when valid and ready are both high; valid does not wait for ready. Latency 1 clock,
// one word a clock. Holds two words: one offered, and one that came in the clock in which the
// receiver stopped.
// rst_n   active low, taken synchronously: empties the slice
module hmlfc_skid_buffer #(
    parameter int WIDTH = 8
) (
    input logic clk,
    input logic rst_n,
    input logic in_valid,
    output logic in_ready,
    input logic [WIDTH-1:0] in_data,
    output logic out_valid,
    input logic out_ready,
    output logic [WIDTH-1:0] out_data
);
  logic [WIDTH-1:0] skid;  // holds a word while in_ready is low and rst_n was high

  always_ff @(posedge clk) begin
    if (in_ready) skid <= in_data;
    if (!out_valid || out_ready) out_data <= in_ready ? in_data : skid;

    if (!rst_n) begin
      in_ready <= 1'b1;
      out_valid <= 1'b0;
    end else if (!out_valid || out_ready) begin
      out_valid <= in_valid || !in_ready;
      in_ready <= 1'b1;
    end else if (in_valid) begin
      in_ready <= 1'b0;
    end
  end
endmodule

`default_nettype wire
