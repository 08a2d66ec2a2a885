`include "specification.svh"

// All values of a sequence of 16 are those of the specification's formula, at each level code with VALUE_BITS = 10 (depth 8), for
// all windows, three clocks after the window; a window each clock. Bits after the sequence's end do not matter.
//
// Clauses: BISE-1 to BISE-9
// Engine: sat 4
// Parts: 7
// Complete: no register has an initial value and the latency is 3; one instance for each level code; simulation changes the
// level code from clock to clock.
// Fault: hmlfc_bise_unpack.sv / .code({d[12], d[10:9] / .code({d[13], d[10:9]
module prove_bise_unpack #(parameter integer PART = 0) (input logic clk, input logic [159:0] window);
  localparam integer COUNT = 16;
  localparam integer W = 10;

  logic [1:0]   clocks = 2'd0;
  logic [159:0] window_1, window_2, window_3;
  always @(posedge clk) begin
    if (clocks != 3) clocks <= clocks + 2'd1;
    window_1 <= window;
    window_2 <= window_1;
    window_3 <= window_2;
  end

  generate
    for (genvar code = 4 * PART; code < 4 * PART + 4; code = code + 1) begin : each
      localparam [14:0] LEVELS = spec_levels(code);
      localparam [2:0] DIGIT = spec_digit(LEVELS);
      localparam integer n = spec_plain(LEVELS);
      localparam integer IN_GROUP = DIGIT == 3 ? 5 : DIGIT == 5 ? 3 : 1;
      localparam integer GROUP_BITS = IN_GROUP * n + (DIGIT == 3 ? 8 : DIGIT == 5 ? 7 : 0);
      // BISE-3, BISE-7.
      localparam integer BITS = n * COUNT + (DIGIT == 3 ? (8 * COUNT + 4) / 5 : DIGIT == 5 ? (7 * COUNT + 2) / 3 : 0);
      wire [255:0] s = {96'd0, window_3 & ~({160{1'b1}} << BITS)};

      logic [COUNT*W-1:0] values;
      hmlfc_bise_unpack #(.COUNT(COUNT), .VALUE_BITS(W), .WINDOW_BITS(160)) dut (
        .clk(clk), .advance(1'b1), .level_code(6'(code)), .window(window), .values(values));

      // BISE-5, BISE-6: the first bit of m_0 to m_4, T and Q in a digit group.
      localparam [39:0] M = DIGIT == 3 ? {8'(4 * n + 7), 8'(3 * n + 5), 8'(2 * n + 4), 8'(n + 2), 8'd0}
                                       : {16'd0, 8'(2 * n + 5), 8'(n + 3), 8'd0};
      for (genvar i = 0; i < COUNT; i = i + 1) begin : value
        localparam integer g = (i / IN_GROUP) * GROUP_BITS;
        localparam integer slot = i % IN_GROUP;
        wire [7:0] T = {s[g+5*n+7], s[g+4*n+6], s[g+4*n+5], s[g+3*n+4], s[g+2*n+3], s[g+2*n+2], s[g+n+1], s[g+n]};
        wire [6:0] Q = {s[g+3*n+6], s[g+3*n+5], s[g+2*n+4], s[g+2*n+3], s[g+n+2], s[g+n+1], s[g+n]};
        wire [9:0] trits = spec_trits(T);
        wire [8:0] quints = spec_quints(Q);
        wire [2:0] d = DIGIT == 3 ? {1'b0, trits[2*slot +: 2]} : DIGIT == 5 ? quints[3*slot +: 3] : 3'd0;
        wire [9:0] m = s[g + M[8*slot +: 8] +: 10] & 10'((1 << n) - 1);
        always @* begin
          if (clocks == 3) begin
            assert ({22'd0, values[W*i +: W]} == (d << n) + {22'd0, m});
            assert ({5'd0, values[W*i +: W]} < LEVELS);
          end
        end
      end
    end
  endgenerate
endmodule
