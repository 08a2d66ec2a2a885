// SPDX-License-Identifier: BSD-3-Clause
// Where value `index` of a sequence lies (BISE-11): its digit group's first bit, its place in that group.
//
// index        [0, 1023]
// level_code   [0, 39]
// group_bit    first bit of the digit group, counted from the sequence's first bit; [0, 14322]
// slot         place in the digit group: [0, 4] with trits, [0, 2] with quints, 0 without digits
// Combinational.
`include "hmlfc_tables.svh"
`default_nettype none

module hmlfc_bise_place (
    input logic [9:0] index,
    input logic [5:0] level_code,
    output logic [13:0] group_bit,
    output logic [2:0] slot
);
  logic [1:0]  kind;
  logic [3:0]  plain_bits;
  logic [7:0]  fifth;
  logic [8:0]  third, group;
  logic [6:0]  group_bits;

  assign kind = hmlfc_digit_kind(level_code);
  assign plain_bits = hmlfc_plain_bits(level_code);

  // 205 / 1024 is 1/5 and 683 / 2048 is 1/3, near enough for every index.
  assign fifth = 8'((20'd205 * {10'd0, index}) >> 10);
  assign third = 9'((21'd683 * {11'd0, index}) >> 11);

  always @* begin
    unique case (kind)
      HMLFC_DIGIT_TRIT: begin
        group = {1'b0, fifth};
        group_bits = 7'd5 * {3'd0, plain_bits} + 7'd8;
        slot = 3'(index - 10'd5 * {2'd0, fifth});
      end
      HMLFC_DIGIT_QUINT: begin
        group = third;
        group_bits = 7'd3 * {3'd0, plain_bits} + 7'd7;
        slot = 3'(index - 10'd3 * {1'b0, third});
      end
      default: begin
        group = 9'd0;
        group_bits = 7'd0;
        slot = 3'd0;
      end
    endcase
  end

  // Values without digits stand alone: their product waits for no division.
  assign group_bit = kind == HMLFC_DIGIT_TRIT || kind == HMLFC_DIGIT_QUINT ? {5'd0, group} * {7'd0, group_bits} :
      {4'd0, index} * {10'd0, plain_bits};
endmodule

`default_nettype wire
