`include "specification.svh"

// The length of a sequence of k values: n * k + d, where d = ceil(8k / 5) or ceil(7k / 3) by the inequalities that
// define it, for all k in [0, 1024] and all 40 level codes, of two clocks before.
//
// Clauses: BISE-3
// Engine: bmc 4
// Complete: nothing but the inputs of two clocks before reaches the length.
module prove_bise_bits (input logic clk, input logic [10:0] count);
  logic [10:0] count_1, count_2;
  logic [1:0]  started = 2'd0;
  always @(posedge clk) begin
    count_1 <= count;
    count_2 <= count_1;
    started <= {started[0], 1'b1};
  end
  generate
    for (genvar code = 0; code < 40; code = code + 1) begin : each
      localparam [14:0] LEVELS = spec_levels(code);
      localparam [2:0] DIGIT = spec_digit(LEVELS);
      logic [13:0] bits;
      hmlfc_bise_bits dut (.clk(clk), .count(count), .level_code(6'(code)), .bits(bits));
      wire signed [31:0] k = count_2;
      wire signed [31:0] d = bits - k * spec_plain(LEVELS);
      always @* begin
        if (started[1] && count_2 <= 1024) begin
          if (DIGIT == 1) assert (d == 0);
          if (DIGIT == 3) assert (5 * d >= 8 * k && 5 * d < 8 * k + 5);
          if (DIGIT == 5) assert (3 * d >= 7 * k && 3 * d < 7 * k + 3);
        end
      end
    end
  endgenerate
endmodule
