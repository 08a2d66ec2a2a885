// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Reads one value of a sequence that lies in a record memory (BISE-11), one a clock.
//
// Latency 4 clocks of `advance`, from value number `index` of the sequence that begins at bit `position` of
// the memory, takes `total` bits and has `level_code`, to `value`. The memory's read port is this module's.
module hmlfc_element_reader #(
    parameter int WORD_BITS = 8,  // of word addresses of the memory
    parameter int VALUE_BITS = 10,
    parameter int WINDOW_BITS = 128,
    localparam int GROUP_BITS = 5 * VALUE_BITS - 2  // of the longest digit group: trits with VALUE_BITS - 2 plain bits
) (
    input logic clk,
    input logic advance,

    input logic [WORD_BITS+5:0] position,
    input logic [13:0] total,
    input logic [5:0] level_code,
    input logic [9:0] index,
    output logic [VALUE_BITS-1:0] value,

    output logic read_enable,
    output logic [WORD_BITS-1:0] read_word,
    input logic [WINDOW_BITS-1:0] window
);

  // 1: place of the value's digit group.
  logic [13:0] group_bit;
  logic [2:0] slot;
  hmlfc_bise_place place (
      .index, .level_code, .group_bit, .slot
  );
  logic [WORD_BITS+5:0] position_1;
  logic [13:0] group_1, total_1;
  logic [5:0] code_1, code_2, code_3;
  logic [2:0] slot_1, slot_2, slot_3;
  always_ff @(posedge clk) begin
    if (advance) begin
      position_1 <= position;
      group_1 <= group_bit;
      total_1 <= total;
      code_1 <= level_code;
      slot_1 <= slot;
    end
  end

  // 2: read the digit group.
  wire [WORD_BITS+5:0] at = position_1 + (WORD_BITS + 6)'(group_1);
  wire [13:0] left = total_1 - group_1;
  assign read_enable = advance;
  assign read_word = at[WORD_BITS+5:6];
  logic [5:0] shift_2;
  logic [6:0] left_2, left_3;
  always_ff @(posedge clk) begin
    if (advance) begin
      shift_2 <= at[5:0];
      left_2 <= left > 14'(GROUP_BITS) ? 7'(GROUP_BITS) : 7'(left);
      code_2 <= code_1;
      slot_2 <= slot_1;
    end
  end

  // 3: its bits.
  logic [GROUP_BITS-1:0] bits_3;
  always_ff @(posedge clk) begin
    if (advance) begin
      bits_3 <= GROUP_BITS'(window >> shift_2);
      left_3 <= left_2;
      code_3 <= code_2;
      slot_3 <= slot_2;
    end
  end

  // 4: its value.
  logic [VALUE_BITS-1:0] element;
  hmlfc_bise_element #(.VALUE_BITS(VALUE_BITS)) decode (
      .window(bits_3), .bits_left(left_3), .level_code(code_3), .slot(slot_3), .value(element)
  );
  always_ff @(posedge clk) if (advance) value <= element;

endmodule

`default_nettype wire
