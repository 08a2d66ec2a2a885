// SPDX-License-Identifier: BSD-3-Clause
// One value of a sequence, read from its digit group (BISE-4 to BISE-9).
//
// VALUE_BITS   [4, 10]; the level count is at most 2^VALUE_BITS
//
// window       the sequence from the digit group's first bit on (hmlfc_bise_place), as long as the longest group
// bits_left    bits from there to the sequence's end, up to those of the window; at least those of the
//              slots up to this (BISE-3); bits beyond read as 0 (BISE-7)
// level_code   [0, 3 * VALUE_BITS - 3]
// slot         place in the digit group: [0, 4] with trits, [0, 2] with quints, 0 without digits
// value        [0, N - 1]
// Combinational.
`include "hmlfc_tables.svh"
`default_nettype none

module hmlfc_bise_element #(
    parameter int VALUE_BITS = 10,
    localparam int GROUP_BITS = 5 * VALUE_BITS - 2
) (
    input logic [GROUP_BITS-1:0] window,
    input logic [6:0] bits_left,
    input logic [5:0] level_code,
    input logic [2:0] slot,
    output logic [VALUE_BITS-1:0] value
);
  logic [1:0]  kind;
  logic [3:0]  n;
  logic [GROUP_BITS-1:0] present;

  assign kind = hmlfc_digit_kind(level_code);
  assign n = hmlfc_plain_bits(level_code);
  assign present = window & ~({GROUP_BITS{1'b1}} << bits_left);

  // Digit bits that stand before the value's plain bits.
  logic [2:0] digits_before;
  always @* begin
    digits_before = 3'd0;
    if (kind == HMLFC_DIGIT_TRIT) begin
      unique case (slot)
        3'd0: digits_before = 3'd0;
        3'd1: digits_before = 3'd2;
        3'd2: digits_before = 3'd4;
        3'd3: digits_before = 3'd5;
        default: digits_before = 3'd7;
      endcase
    end else if (kind == HMLFC_DIGIT_QUINT) begin
      unique case (slot)
        3'd0: digits_before = 3'd0;
        3'd1: digits_before = 3'd3;
        default: digits_before = 3'd5;
      endcase
    end
  end

  logic [5:0]            start;
  logic [VALUE_BITS-1:0] above, plain;
  assign start = {3'd0, slot} * {2'd0, n} + {3'd0, digits_before};
  assign above = {VALUE_BITS{1'b1}} << n;
  assign plain = VALUE_BITS'(present >> start) & ~above;

  // The digit group's code, T or Q, from its places for each n.
  logic [7:0] t;
  logic [6:0] q;
  always @* begin
    t = 8'd0;
    q = 7'd0;
    for (int k = 0; k <= VALUE_BITS - 2; k = k + 1) begin
      t = t | ({present[5*k+7], present[4*k+5 +: 2], present[3*k+4], present[2*k+2 +: 2],
                present[k +: 2]} & {8{n == k[3:0]}});
      q = q | ({present[3*k+5 +: 2], present[2*k+3 +: 2], present[k +: 3]} & {7{n == k[3:0]}});
    end
  end

  logic [9:0] trits;
  logic [8:0] quints;
  hmlfc_trits decode_trits (.code(t), .trits(trits));
  hmlfc_quints decode_quints (.code(q), .quints(quints));

  logic [2:0] digit;
  always @* begin
    unique case (kind)
      HMLFC_DIGIT_TRIT: digit = {1'b0, 2'(trits >> {slot, 1'b0})};
      HMLFC_DIGIT_QUINT: digit = 3'(quints >> (4'd3 * {1'b0, slot}));
      default: digit = 3'd0;
    endcase
  end

  assign value = plain | ({{(VALUE_BITS - 3) {1'b0}}, digit} << n);
endmodule

`default_nettype wire
