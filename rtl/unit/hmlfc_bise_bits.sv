// SPDX-License-Identifier: BSD-3-Clause
// Length of a sequence of `count` values (BISE-3), two clocks later.
//
// count        [0, 1024]
// level_code   [0, 39]
// bits         [0, 14336]
`include "hmlfc_tables.svh"
`default_nettype none

module hmlfc_bise_bits (
    input logic clk,
    input logic [10:0] count,
    input logic [5:0] level_code,
    output logic [13:0] bits
);
  logic [13:0] plain, digits;

  // ceil(8k / 5) = floor((8k + 4) / 5) with 3277 / 2^14 for 1/5, and ceil(7k / 3) = floor((7k + 2) / 3) with 10923 /
  // 2^15 for 1/3: near enough for every count. Multiplied out, each is one product and one addition.
  wire [13:0] trit_bits = 14'((24'd6554 * {13'd0, count} + 24'd3277) >> 12);
  wire [13:0] quint_bits = 14'((28'd76461 * {17'd0, count} + 28'd21846) >> 15);

  always_ff @(posedge clk) begin
    // 1: bits of the plain parts and of the digits.
    plain <= {3'd0, count} * {10'd0, hmlfc_plain_bits(level_code)};
    unique case (hmlfc_digit_kind(level_code))
      HMLFC_DIGIT_TRIT: digits <= trit_bits;
      HMLFC_DIGIT_QUINT: digits <= quint_bits;
      default: digits <= '0;
    endcase
    // 2: both.
    bits <= plain + digits;
  end
endmodule

`default_nettype wire
