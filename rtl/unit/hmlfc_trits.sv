// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The five trits of a digit group's code T (BISE-8). Every code is valid (BISE-10).
//
// code      T, [0, 255]
// trits     trit j, in [0, 2], at bits 2 * j on
// Combinational.
module hmlfc_trits (
    input logic [7:0] code,
    output logic [9:0] trits
);
  logic       upper_twos;  // T[4:2] = 7
  logic [4:0] c;
  logic [1:0] t0, t1, t2, t3, t4;

  assign upper_twos = code[4:2] == 3'd7;
  assign c = upper_twos ? {code[7:5], code[1:0]} : code[4:0];

  always @* begin
    if (upper_twos) begin
      t4 = 2'd2;
      t3 = 2'd2;
    end else if (code[6:5] == 2'd3) begin
      t4 = 2'd2;
      t3 = {1'b0, code[7]};
    end else begin
      t4 = {1'b0, code[7]};
      t3 = code[6:5];
    end
  end

  always @* begin
    if (c[1:0] == 2'd3) begin
      t2 = 2'd2;
      t1 = {1'b0, c[4]};
      t0 = {c[3], c[2] & ~c[3]};
    end else if (c[3:2] == 2'd3) begin
      t2 = 2'd2;
      t1 = 2'd2;
      t0 = c[1:0];
    end else begin
      t2 = {1'b0, c[4]};
      t1 = c[3:2];
      t0 = {c[1], c[0] & ~c[1]};
    end
  end

  assign trits = {t4, t3, t2, t1, t0};
endmodule

`default_nettype wire
