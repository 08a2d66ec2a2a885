// Each of the three stages computes its part of the formula exactly, in integers of 20 bits, so that nothing overflows and the
// prediction is that of MOT-9: for all samples of ref that MAX_DEPTH = 8 has (10 bits), all weights, one reference and two; a block each clock.
// Position (0, 0) of the first reference: each other position is the same expression of its own samples.
//   along rows      (8 - fx) * left + fx * right, of any samples
//   along columns   I = (8 - fy) * upper + fy * lower, of any two numbers in 8 times the interval of a sample
//   rounding        (I + 32) >> 6, or (I_first + I_second + 64) >> 7, of any two in 64 times that interval
// The stages before are proved to stay in these intervals.
//
// Clauses: MOT-9, section 11 (I; I_first + I_second + 64)
// Engine: sat 2
// Complete: no register has an initial value, so the first clock is in any state.
// Fault: hmlfc_interpolate.sv / TOTAL_BITS'(64) / TOTAL_BITS'(63)
// Fault: hmlfc_interpolate.sv / {{3{m0[SAMPLE_BITS-1]}}, m0} / {3'd0, m0}
// Fault: hmlfc_interpolate.sv / m2 = fy_rows[3*r+2] ? lower : upper / m2 = fy_rows[3*r+2] ? upper : lower
module prove_interpolate (
  input logic clk, input logic [89:0] window_a, input logic [89:0] window_b,
  input logic [2:0] fx_a, input logic [2:0] fy_a, input logic [2:0] fx_b, input logic [2:0] fy_b, input logic two
);
  localparam integer W = 10;
  localparam integer R = W + 3;
  localparam integer S = W + 6;
  localparam signed [19:0] LEAST = -(20'sd1 <<< (W - 1));
  localparam signed [19:0] GREATEST = (20'sd1 <<< (W - 1)) - 1;
  logic [4*W-1:0] prediction;
  hmlfc_interpolate #(.BLOCK_LOG2(1), .SAMPLE_BITS(W)) dut (
    .clk(clk), .advance(1'b1), .window_a(window_a), .window_b(window_b), .fx_a(fx_a), .fy_a(fy_a), .fx_b(fx_b), .fy_b(fy_b),
    .two(two), .prediction(prediction));

  // The stages' registers.
  (* hierconn *) wire [12*R-1:0] \dut.rows ;
  (* hierconn *) wire [8*S-1:0] \dut.sums ;
  (* hierconn *) wire [5:0] \dut.fy_rows ;
  (* hierconn *) wire \dut.two_rows ;
  (* hierconn *) wire \dut.two_sums ;

  logic            second = 1'b0;
  logic [179:0]    windows;
  logic [12*R-1:0] rows;
  logic [8*S-1:0]  sums;
  logic [5:0]      fx, fy, fy_1;
  logic            two_0, two_1, two_2;
  always @(posedge clk) begin
    second <= 1'b1;
    windows <= {window_b, window_a};
    fx <= {fx_b, fx_a};
    fy <= {fy_b, fy_a};
    fy_1 <= \dut.fy_rows ;
    two_0 <= two;
    two_1 <= \dut.two_rows ;
    two_2 <= \dut.two_sums ;
    rows <= \dut.rows ;
    sums <= \dut.sums ;
  end

  always @* if (second) assert (\dut.fy_rows == fy && \dut.two_rows == two_0 && \dut.two_sums == two_1);

  generate
    for (genvar r = 0; r < 1; r = r + 1) begin : reference
      wire signed [19:0] weight_x = {17'd0, fx[3*r +: 3]};
      wire signed [19:0] weight_y = {17'd0, fy_1[3*r +: 3]};
      for (genvar x = 0; x < 1; x = x + 1) begin : column
        for (genvar y = 0; y < 1; y = y + 1) begin : along_row
          wire signed [19:0] left = $signed(windows[90*r + (3*y+x)*W +: W]);
          wire signed [19:0] right = $signed(windows[90*r + (3*y+x+1)*W +: W]);
          wire signed [19:0] got = $signed(\dut.rows [((r*3+y)*2+x)*R +: R]);
          for (genvar w = 0; w < 8; w = w + 1) begin : weight
            always @* if (second && weight_x == w) assert (got == (8 - w) * left + w * right);
          end
          always @* if (second) assert (got >= 20'sd8 * LEAST && got <= 20'sd8 * GREATEST);
        end
        for (genvar y = 0; y < 1; y = y + 1) begin : along_column
          wire signed [19:0] upper = $signed(rows[((r*3+y)*2+x)*R +: R]);
          wire signed [19:0] lower = $signed(rows[((r*3+y+1)*2+x)*R +: R]);
          wire signed [19:0] got = $signed(\dut.sums [((r*2+y)*2+x)*S +: S]);
          always @* assume (upper >= 20'sd8 * LEAST && upper <= 20'sd8 * GREATEST && lower >= 20'sd8 * LEAST && lower <= 20'sd8 * GREATEST);
          for (genvar w = 0; w < 8; w = w + 1) begin : weight
            always @* if (second && weight_y == w) assert (got == (8 - w) * upper + w * lower);
          end
          always @* if (second) assert (got >= 20'sd64 * LEAST && got <= 20'sd64 * GREATEST);
        end
      end
    end
    for (genvar i = 0; i < 1; i = i + 1) begin : rounding
      wire signed [19:0] i_first = $signed(sums[i*S +: S]);
      wire signed [19:0] i_second = $signed(sums[(4+i)*S +: S]);
      wire signed [19:0] got = $signed(prediction[i*W +: W]);
      always @* assume (i_first >= 20'sd64 * LEAST && i_first <= 20'sd64 * GREATEST);
      always @* assume (i_second >= 20'sd64 * LEAST && i_second <= 20'sd64 * GREATEST);
      always @* if (second) assert (got == (two_2 ? (i_first + i_second + 20'sd64) >>> 7 : (i_first + 20'sd32) >>> 6));
    end
  endgenerate
endmodule
