// Each of the three stages computes its part of the formula exactly, in integers of 20 bits, so that nothing overflows and the
// prediction is that of MOT-9: for all samples of ref that MAX_DEPTH = 8 has (10 bits), all weights, one reference and two, blocks of
// 4 x 4, a block each clock.
//   along rows      (8 - fx) * left + fx * right, of any samples
//   along columns   I = (8 - fy) * upper + fy * lower, of any two numbers in 8 times the interval of a sample
//   rounding        (I + 32) >> 6, or (I_first + I_second + 64) >> 7, of any two in 64 times that interval
// The stages before are proved to stay in these intervals. This is proved of position (0, 0) of a unit `one` for blocks of 2 x 2; and each
// position of 4 x 4 is that of such a unit which gets the position's samples.
//
// Clauses: MOT-9, section 11 (I; I_first + I_second + 64)
// Engine: sat 2
// Still: hmlfc_interpolate advance
// Complete: no register has an initial value, so the first clock is in any state.
// Fault: hmlfc_interpolate.sv / TOTAL_BITS'(64) / TOTAL_BITS'(63)
// Fault: hmlfc_interpolate.sv / {{3{m0[SAMPLE_BITS-1]}}, m0} / {3'd0, m0}
// Fault: hmlfc_interpolate.sv / m2 = fy_rows[3*r+2] ? lower : upper / m2 = fy_rows[3*r+2] ? upper : lower
// Fault: hmlfc_interpolate.sv / m1 = fx[3*r+1] / m1 = fx[1]
// Fault: hmlfc_interpolate.sv / AT = r * WINDOW + (y * SIDE + x) / AT = r * WINDOW + (y * SIDE + (x == 1 ? 0 : x))
// Fault: hmlfc_interpolate.sv / sums[(B*B+x)*SUM_BITS +: SUM_BITS] / sums[(B*B+(x==3?0:x))*SUM_BITS +: SUM_BITS]
// Fault: hmlfc_interpolate.sv / if (advance) begin / begin
module prove_interpolate (
  input logic clk, input logic [249:0] window_a, input logic [249:0] window_b,
  input logic [2:0] fx_a, input logic [2:0] fy_a, input logic [2:0] fx_b, input logic [2:0] fy_b, input logic two
);
  localparam integer W = 10;
  localparam integer R = W + 3;
  localparam integer S = W + 6;
  localparam signed [19:0] LEAST = -(20'sd1 <<< (W - 1));
  localparam signed [19:0] GREATEST = (20'sd1 <<< (W - 1)) - 1;

  // ---- All positions are alike.
  logic [16*W-1:0] prediction;
  hmlfc_interpolate #(.BLOCK_LOG2(2), .SAMPLE_BITS(W)) dut (
    .clk(clk), .advance(1'b1), .window_a(window_a), .window_b(window_b), .fx_a(fx_a), .fy_a(fy_a), .fx_b(fx_b), .fy_b(fy_b),
    .two(two), .prediction(prediction));

  // The samples (x, y) to (x + 1, y + 1) of a window of 5 x 5 in the first places of one of 3 x 3; the others are 0.
  function automatic [89:0] corner(input [249:0] window, input integer x, input integer y);
    corner = 90'd0;
    corner[0 +: 2*W] = window[(5*y+x)*W +: 2*W];
    corner[3*W +: 2*W] = window[(5*y+5+x)*W +: 2*W];
  endfunction
  generate
    for (genvar i = 0; i < 16; i = i + 1) begin : position
      logic [4*W-1:0] alike;
      hmlfc_interpolate #(.BLOCK_LOG2(1), .SAMPLE_BITS(W)) one (
        .clk(clk), .advance(1'b1), .window_a(corner(window_a, i % 4, i / 4)), .window_b(corner(window_b, i % 4, i / 4)),
        .fx_a(fx_a), .fy_a(fy_a), .fx_b(fx_b), .fy_b(fy_b), .two(two), .prediction(alike));
      always @* assert (prediction[i*W +: W] == alike[0 +: W]);
    end
  endgenerate

  // ---- Position (0, 0).
  logic [4*W-1:0] first_prediction;
  hmlfc_interpolate #(.BLOCK_LOG2(1), .SAMPLE_BITS(W)) one (
    .clk(clk), .advance(1'b1), .window_a(corner(window_a, 0, 0)), .window_b(corner(window_b, 0, 0)), .fx_a(fx_a), .fy_a(fy_a),
    .fx_b(fx_b), .fy_b(fy_b), .two(two), .prediction(first_prediction));
  (* hierconn *) wire [12*R-1:0] \one.rows ;
  (* hierconn *) wire [8*S-1:0] \one.sums ;
  (* hierconn *) wire [5:0] \one.fy_rows ;
  (* hierconn *) wire \one.two_rows ;
  (* hierconn *) wire \one.two_sums ;
  wire signed [19:0] first = $signed(first_prediction[0 +: W]);

  // What was there a clock ago.
  logic              second = 1'b0;
  logic [2*90-1:0]   windows;
  logic [12*R-1:0]   rows;
  logic [8*S-1:0]    sums;
  logic [5:0]        fx, fy, fy_1;
  logic              two_0, two_1, two_2;
  always @(posedge clk) begin
    second <= 1'b1;
    windows <= {corner(window_b, 0, 0), corner(window_a, 0, 0)};
    fx <= {fx_b, fx_a};
    fy <= {fy_b, fy_a};
    fy_1 <= \one.fy_rows ;
    two_0 <= two;
    two_1 <= \one.two_rows ;
    two_2 <= \one.two_sums ;
    rows <= \one.rows ;
    sums <= \one.sums ;
  end
  always @* if (second) assert (\one.fy_rows == fy && \one.two_rows == two_0 && \one.two_sums == two_1);

  generate
    for (genvar r = 0; r < 2; r = r + 1) begin : reference
      wire signed [19:0] left = $signed(windows[90*r +: W]);
      wire signed [19:0] right = $signed(windows[90*r + W +: W]);
      wire signed [19:0] row = $signed(\one.rows [6*r*R +: R]);
      wire signed [19:0] upper = $signed(rows[6*r*R +: R]);
      wire signed [19:0] lower = $signed(rows[(6*r+2)*R +: R]);
      wire signed [19:0] sum = $signed(\one.sums [4*r*S +: S]);
      always @* assume (upper >= 20'sd8 * LEAST && upper <= 20'sd8 * GREATEST && lower >= 20'sd8 * LEAST && lower <= 20'sd8 * GREATEST);
      for (genvar w = 0; w < 8; w = w + 1) begin : weight
        always @* if (second && fx[3*r +: 3] == w) assert (row == (8 - w) * left + w * right);
        always @* if (second && fy_1[3*r +: 3] == w) assert (sum == (8 - w) * upper + w * lower);
      end
      always @* if (second) assert (row >= 20'sd8 * LEAST && row <= 20'sd8 * GREATEST);
      always @* if (second) assert (sum >= 20'sd64 * LEAST && sum <= 20'sd64 * GREATEST);
    end
  endgenerate
  wire signed [19:0] i_first = $signed(sums[0 +: S]);
  wire signed [19:0] i_second = $signed(sums[4*S +: S]);
  always @* begin
    assume (i_first >= 20'sd64 * LEAST && i_first <= 20'sd64 * GREATEST);
    assume (i_second >= 20'sd64 * LEAST && i_second <= 20'sd64 * GREATEST);
    if (second) assert (first == (two_2 ? (i_first + i_second + 20'sd64) >>> 7 : (i_first + 20'sd32) >>> 6));
  end
endmodule
