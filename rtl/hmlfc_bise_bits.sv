// Length of a sequence of `count` values (BISE-3).
//
// count        [0, 1024]
// level_code   [0, 39]
// bits         [0, 14336]
// Combinational.
`include "hmlfc_tables.svh"

module hmlfc_bise_bits (
  input  logic [10:0] count,
  input  logic [5:0]  level_code,
  output logic [13:0] bits
);
  logic [13:0] plain, trit_bits, quint_bits;

  assign plain = {3'd0, count} * {10'd0, hmlfc_plain_bits(level_code)};

  // ceil(8k / 5) = floor((8k + 4) / 5) by 13108 / 65536, ceil(7k / 3) = floor((7k + 2) / 3) by
  // 10923 / 32768: near enough to 1/5 and 1/3 for every count.
  assign trit_bits = 14'((29'd13108 * (29'd8 * {18'd0, count} + 29'd4)) >> 16);
  assign quint_bits = 14'((29'd10923 * (29'd7 * {18'd0, count} + 29'd2)) >> 15);

  always @* begin
    case (hmlfc_digit_kind(level_code))
      HMLFC_DIGIT_TRIT: bits = plain + trit_bits;
      HMLFC_DIGIT_QUINT: bits = plain + quint_bits;
      default: bits = plain;
    endcase
  end
endmodule
