`include "specification.svh"

// The residuals are those of the formula in integers of 32 bits, so nothing overflows, and lie in [-M, M]: for every
// depth 8 to 12, level code, bias, step and value in [0, N - 1]; four clocks after their input, a block each clock.
// MAX_DEPTH = 12; blocks of 4 x 4. This is proved of position 0; and where the values go to the positions below theirs,
// so do the residuals.
//
// Clauses: TIL-10, STP-2, STP-3, section 11 (residual before its clamp; step * residual)
// Engine: sat 5
// Still: hmlfc_residual advance
// Complete: no register has an initial value and the latency is 4.
module prove_residual (
  input logic clk, input logic [223:0] values, input logic [5:0] level_code, input logic [13:0] bias,
      input logic [3:0] step_code,
  input logic chroma, input logic [3:0] depth
);
  logic [223:0] residuals, turned;
  hmlfc_residual #(.BLOCK_LOG2(2), .MAX_DEPTH(12)) dut (
    .clk(clk), .advance(1'b1), .values(values), .level_code(level_code), .bias(bias), .step_code(step_code),
    .chroma(chroma), .depth(depth), .residuals(residuals));
  hmlfc_residual #(.BLOCK_LOG2(2), .MAX_DEPTH(12)) turned_dut (
    .clk(clk), .advance(1'b1), .values({values[13:0], values[223:14]}), .level_code(level_code), .bias(bias),
    .step_code(step_code), .chroma(chroma), .depth(depth), .residuals(turned));
  always @* assert (turned == {residuals[13:0], residuals[223:14]});

  // STP-2.
  wire signed [31:0] hi = (32'd1 << depth) - 1;
  wire signed [31:0] bound = chroma ? 2 * hi : hi;
  wire [14:0]        levels = spec_levels(level_code);
  wire signed [31:0] value = values[13:0];
  wire signed [31:0] b = $signed(bias);
  wire signed [31:0] centred = spec_clamp(value - $signed({17'd0, levels >> 1}) + b, -bound, bound);
  wire signed [31:0] once = step_code == 0 ? centred : step_code[0] ? centred : 3 * centred;
  wire signed [31:0] product = once <<< (step_code == 0 ? 0 : step_code[0] ? (step_code + 5'd1) >> 1 :
      (step_code - 5'd2) >> 1);

  logic [2:0]         clocks = 3'd0;
  logic signed [31:0] expected_1, expected_2, expected_3, expected_4, bound_1, bound_2, bound_3, bound_4;
  always @(posedge clk) begin
    if (clocks != 4) clocks <= clocks + 3'd1;
    {expected_1, bound_1} <= {spec_clamp(product, -bound, bound), bound};
    {expected_2, bound_2} <= {expected_1, bound_1};
    {expected_3, bound_3} <= {expected_2, bound_2};
    {expected_4, bound_4} <= {expected_3, bound_3};
  end
  wire signed [31:0] got = $signed(residuals[13:0]);
  always @* begin
    assume (depth >= 8 && depth <= 12);
    assume ({2'd0, level_code} <= 8'd27 + 8'd3 * ({4'd0, depth} - 8'd8));
    assume (value < $signed({17'd0, levels}));
    assume (b >= -(2 <<< depth) && b <= (2 <<< depth) - 1);
    if (clocks == 4) begin
      assert (got == expected_4);
      assert (got >= -bound_4 && got <= bound_4);
    end
  end
endmodule
