// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The three quints of a digit group's code Q (BISE-9). Every code is valid (BISE-10).
//
// code      Q, [0, 127]
// quints    quint j, in [0, 4], at bits 3 * j on
// Combinational.
module hmlfc_quints (
    input logic [6:0] code,
    output logic [8:0] quints
);
  logic       two_fours;  // q0 and q1 are 4
  logic       upper_four;  // Q[2:1] = 3
  logic [4:0] c;
  logic [2:0] q0, q1, q2;

  assign upper_four = code[2:1] == 2'd3;
  assign two_fours = upper_four && code[6:5] == 2'd0;
  assign c = upper_four ? {code[4:3], ~code[6:5], code[0]} : code[4:0];

  always @* begin
    if (two_fours) begin
      q2 = {code[0], code[4] & ~code[0], code[3] & ~code[0]};
      q1 = 3'd4;
      q0 = 3'd4;
    end else begin
      q2 = upper_four ? 3'd4 : {1'b0, code[6:5]};
      q1 = c[2:0] == 3'd5 ? 3'd4 : {1'b0, c[4:3]};
      q0 = c[2:0] == 3'd5 ? {1'b0, c[4:3]} : c[2:0];
    end
  end

  assign quints = {q2, q1, q0};
endmodule

`default_nettype wire
