`include "specification.svh"

// The pixels are those of the formula in integers of 32 bits, so nothing overflows before the clamps: for every depth 8
// to 12 and all samples in their intervals, two clocks after their input. MAX_DEPTH = 12; blocks of 4 x 4. This is
// proved of pixel 0; and where the samples go to the positions below theirs, so do the pixels.
//
// Clauses: COL-2, section 11 (t; R, G, B before their clamps)
// Engine: sat 3
// Still: hmlfc_colour advance
// Complete: no register has an initial value and the latency is 2.
module prove_colour (
  input logic clk, input logic [207:0] y, input logic [207:0] co, input logic [207:0] cg, input logic [3:0] depth
);
  logic [767:0] lanes, turned;
  hmlfc_colour #(.BLOCK_LOG2(2), .MAX_DEPTH(12)) dut (.clk(clk), .advance(1'b1), .y(y), .co(co), .cg(cg),
      .depth(depth), .lanes(lanes));
  hmlfc_colour #(.BLOCK_LOG2(2), .MAX_DEPTH(12)) turned_dut (
    .clk(clk), .advance(1'b1), .y({y[12:0], y[207:13]}), .co({co[12:0], co[207:13]}), .cg({cg[12:0], cg[207:13]}),
    .depth(depth), .lanes(turned));
  always @* assert (turned == {lanes[527:512], lanes[767:528], lanes[271:256], lanes[511:272], lanes[15:0],
      lanes[255:16]});

  wire signed [31:0] hi = (32'd1 << depth) - 1;
  wire signed [31:0] Y = $signed(y[12:0]);
  wire signed [31:0] Co = $signed(co[12:0]);
  wire signed [31:0] Cg = $signed(cg[12:0]);
  wire signed [31:0] t = Y - (Cg >>> 1);
  wire signed [31:0] G = Cg + t;
  wire signed [31:0] B = t - (Co >>> 1);
  wire signed [31:0] R = B + Co;
  logic [1:0]  clocks = 2'd0;
  logic [47:0] expected_1, expected_2;
  always @(posedge clk) begin
    if (clocks != 2) clocks <= clocks + 2'd1;
    expected_1[15:0] <= spec_clamp(R, 0, hi);
    expected_1[31:16] <= spec_clamp(G, 0, hi);
    expected_1[47:32] <= spec_clamp(B, 0, hi);
    expected_2 <= expected_1;
  end
  always @* begin
    assume (depth >= 8 && depth <= 12);
    assume (Y >= 0 && Y <= hi && Co >= -hi && Co <= hi && Cg >= -hi && Cg <= hi);
    if (clocks == 2) begin
      assert (lanes[15:0] == expected_2[15:0]);
      assert (lanes[271:256] == expected_2[31:16]);
      assert (lanes[527:512] == expected_2[47:32]);
    end
  end
endmodule
