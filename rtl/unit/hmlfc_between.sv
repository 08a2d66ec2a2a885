// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Eight times the value at `eighths` of the way from `first` to `second`: (8 - f) a + f b, not rounded.
//
// SAMPLE_BITS     of a and b, in two's complement
// eighths         f, [0, 7]
// value           with s = a + b, bits f0 to f2 of f, and m = b if f2 is set, else a:
//                 (f0 ? s : 2a) + 2 ((f1 != f2 ? s : 2m) + m): three additions and no product
// Combinational.
module hmlfc_between #(
    parameter int SAMPLE_BITS = 10,
    localparam int VALUE_BITS = SAMPLE_BITS + 3
) (
    input logic signed [SAMPLE_BITS-1:0] first,
    input logic signed [SAMPLE_BITS-1:0] second,
    input logic [2:0] eighths,
    output logic signed [VALUE_BITS-1:0] value
);
  wire signed [VALUE_BITS-1:0] a = VALUE_BITS'(first);
  wire signed [VALUE_BITS-1:0] s = VALUE_BITS'(first) + VALUE_BITS'(second);
  wire signed [VALUE_BITS-1:0] m = eighths[2] ? VALUE_BITS'(second) : VALUE_BITS'(first);
  wire signed [VALUE_BITS-1:0] low = eighths[0] ? s : a <<< 1;
  wire signed [VALUE_BITS-1:0] high = eighths[1] != eighths[2] ? s : m <<< 1;
  assign value = low + ((high + m) <<< 1);
endmodule

`default_nettype wire
