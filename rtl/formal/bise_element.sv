`include "specification.svh"

// One value of a sequence is the value that its digit group's bits stand for, at each level code with VALUE_BITS = 10
// (depth 8) and each slot, for all windows and all numbers of bits that are left; bits past the end count as 0.
//
// Clauses: BISE-1, BISE-2, BISE-4 to BISE-9
// Engine: sat 1
// Complete: combinational; one instance for each level code and slot.
module prove_bise_element #(
  parameter integer VALUE_BITS = 10,
  localparam integer G = 5 * VALUE_BITS - 2  // bits of the longest digit group
) (input logic [G-1:0] window, input logic [6:0] bits_left);
  wire [G-1:0] present = window & ~({G{1'b1}} << bits_left);
  generate
    for (genvar code = 0; code <= 3 * VALUE_BITS - 3; code = code + 1) begin : each
      localparam [14:0] LEVELS = spec_levels(code);
      localparam [2:0] DIGIT = spec_digit(LEVELS);
      localparam integer n = spec_plain(LEVELS);
      localparam integer IN_GROUP = DIGIT == 3 ? 5 : DIGIT == 5 ? 3 : 1;

      // BISE-5, BISE-6: the first bit of m_0 to m_4, T and Q.
      localparam [39:0] M = DIGIT == 3 ? {8'(4 * n + 7), 8'(3 * n + 5), 8'(2 * n + 4), 8'(n + 2), 8'd0}
                                       : {16'd0, 8'(2 * n + 5), 8'(n + 3), 8'd0};
      wire [95:0] s = 96'(present);
      wire [7:0]  T = {s[5*n+7], s[4*n+6], s[4*n+5], s[3*n+4], s[2*n+3], s[2*n+2], s[n+1], s[n]};
      wire [6:0]  Q = {s[3*n+6], s[3*n+5], s[2*n+4], s[2*n+3], s[n+2], s[n+1], s[n]};
      wire [9:0]  trits = spec_trits(T);
      wire [8:0]  quints = spec_quints(Q);

      for (genvar slot = 0; slot < IN_GROUP; slot = slot + 1) begin : at
        wire [2:0]   d = DIGIT == 3 ? {1'b0, trits[2*slot +: 2]} : DIGIT == 5 ? quints[3*slot +: 3] : 3'd0;
        wire [9:0]   m = s[M[8*slot +: 8] +: 10] & 10'((1 << n) - 1);
        logic [VALUE_BITS-1:0] value;
        hmlfc_bise_element #(.VALUE_BITS(VALUE_BITS)) dut (
          .window(window), .bits_left(bits_left), .level_code(6'(code)), .slot(3'(slot)), .value(value));
        always @* begin
          if (bits_left <= G) begin
            assert (32'(value) == (d << n) + {22'd0, m});
            assert (15'(value) < LEVELS);
          end
        end
      end
    end
  endgenerate
endmodule
