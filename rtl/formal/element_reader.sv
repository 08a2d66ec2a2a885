// A value of a sequence, with any stalls: the word where its digit group begins is read two clocks after it is asked
// for, and two clocks later the value is what hmlfc_bise_element makes of the bits of the window from there on (proof
// bise_element), at the place of hmlfc_bise_place (proof bise_place); for values within the sequence. WORD_BITS = 8,
// VALUE_BITS = 10, WINDOW_BITS = 128.
//
// Clauses: BISE-11
// Engine: bmc 6
// Complete: four stages without feedback.
module prove_element_reader #(
  parameter integer WORD_BITS = 8,
  parameter integer VALUE_BITS = 10,
  parameter integer WINDOW_BITS = 128,
  localparam integer G = 5 * VALUE_BITS - 2
) (
  input logic clk, input logic advance, input logic [WORD_BITS+5:0] position, input logic [13:0] total,
      input logic [5:0] level_code,
  input logic [9:0] index, input logic [WINDOW_BITS-1:0] window
);
  logic [VALUE_BITS-1:0] value;
  logic                  read_enable;
  logic [WORD_BITS-1:0]  read_word;
  hmlfc_element_reader #(.WORD_BITS(WORD_BITS), .VALUE_BITS(VALUE_BITS), .WINDOW_BITS(WINDOW_BITS)) dut (
    .clk(clk), .advance(advance), .position(position), .total(total), .level_code(level_code), .index(index),
    .value(value), .read_enable(read_enable), .read_word(read_word), .window(window));

  logic [13:0] group_bit;
  logic [2:0]  slot;
  hmlfc_bise_place place (.index(index), .level_code(level_code), .group_bit(group_bit), .slot(slot));

  // What was asked for so many clocks ago: the bit where its group begins, the sequence's bits from there on, its code
  // and slot.
  localparam integer ASKED = WORD_BITS + 6 + 14 + 6 + 3;
  logic [3:0]       filled = 4'd0;
  logic [ASKED-1:0] asked_1, asked_2, asked_3;
  logic [G-1:0]     bits;
  wire [WORD_BITS+5:0] begins_1 = asked_1[ASKED-1 -: WORD_BITS+6];
  wire [5:0]           shift_2 = asked_2[23 +: 6];
  wire [13:0]          left_3 = asked_3[9 +: 14];
  wire [WINDOW_BITS-1:0] shifted = window >> shift_2;
  logic [VALUE_BITS-1:0] element, expected;
  (* hierconn *) wire [G-1:0] \dut.bits_3 ;
  (* hierconn *) wire [6:0] \dut.left_3 ;
  (* hierconn *) wire [5:0] \dut.code_3 ;
  (* hierconn *) wire [2:0] \dut.slot_3 ;
  hmlfc_bise_element #(.VALUE_BITS(VALUE_BITS)) decode (
    .window(\dut.bits_3 ), .bits_left(\dut.left_3 ), .level_code(\dut.code_3 ), .slot(\dut.slot_3 ), .value(element));
  always @(posedge clk) begin
    if (advance) begin
      filled <= {filled[2:0], 1'b1};
      asked_1 <= {(WORD_BITS+6)'(position + group_bit), 14'(total - group_bit), level_code, slot};
      {asked_3, asked_2} <= {asked_2, asked_1};
      bits <= shifted[G-1:0];
      expected <= element;
    end
  end
  always @* begin
    assume (level_code <= 3 * VALUE_BITS - 3 && group_bit <= total);
    assert (read_enable == advance);
    if (filled[0]) assert (read_word == begins_1[WORD_BITS+5:6]);
    if (filled[2])
      assert (\dut.bits_3 == bits && \dut.left_3 == (left_3 < G ? left_3[6:0] : 7'(G)) &&
          {\dut.code_3 , \dut.slot_3 } == asked_3[8:0]);
    if (filled[3]) assert (value == expected);
  end
endmodule
