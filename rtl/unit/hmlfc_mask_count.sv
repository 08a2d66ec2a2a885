// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The 1 bits of a mask below a bit, or all of them (rank of CNV-6), three clocks of `advance` later; one mask a clock.
module hmlfc_mask_count (
    input logic clk,
    input logic advance,
    input logic [63:0] mask,
    input logic all,
    input logic [5:0] place,
    output logic [6:0] count
);

  logic [63:0] counted;
  logic [8*4-1:0] counts;
  always_ff @(posedge clk) begin
    if (advance) begin
      counted <= all ? mask : mask & ~(64'hFFFF_FFFF_FFFF_FFFF << place);
      for (int i = 0; i < 8; i++) begin
        counts[i*4+:4] <= ((4'(counted[i*8]) + 4'(counted[i*8+1])) + (4'(counted[i*8+2]) + 4'(counted[i*8+3]))) +
            ((4'(counted[i*8+4]) + 4'(counted[i*8+5])) + (4'(counted[i*8+6]) + 4'(counted[i*8+7])));
      end
      count <= ((7'(counts[0+:4]) + 7'(counts[4+:4])) + (7'(counts[8+:4]) + 7'(counts[12+:4]))) +
          ((7'(counts[16+:4]) + 7'(counts[20+:4])) + (7'(counts[24+:4]) + 7'(counts[28+:4])));
    end
  end

endmodule

`default_nettype wire
