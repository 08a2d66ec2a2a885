// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// A memory with one port that writes and one that reads: the module to replace by memory macros of a chip.
//
// WIDTH   >= 1, bits of a word
// DEPTH   words, a power of two, at least 2
//
// With `read` the word of `read_address` is at `read_data` in the next clock, and stays there until the next read. What
// a read gives of a word that is written in the same clock is undefined, and nobody uses it: a simulation gives the
// inverse of the word that was there, so that a use of it shows. No word is reset.
module hmlfc_ram #(
    parameter int WIDTH = 8,
    parameter int DEPTH = 16
) (
    input logic clk,
    input logic write,
    input logic [$clog2(DEPTH)-1:0] write_address,
    input logic [WIDTH-1:0] write_data,
    input logic read,
    input logic [$clog2(DEPTH)-1:0] read_address,
    output logic [WIDTH-1:0] read_data
);
`ifndef __ICARUS__  // version 11 has no elaboration tasks
  if (DEPTH != 1 << $clog2(DEPTH) || DEPTH < 2) begin : check_depth $error("DEPTH is a power of two, at least 2"); end
`endif

  (* no_rw_check *) logic [WIDTH-1:0] words [0:DEPTH-1];

  always_ff @(posedge clk) begin
    if (write) words[write_address] <= write_data;
    if (read) read_data <= words[read_address];
`ifndef SYNTHESIS
    if (read && write && read_address == write_address) read_data <= ~words[read_address];
`endif
  end
endmodule

`default_nettype wire
