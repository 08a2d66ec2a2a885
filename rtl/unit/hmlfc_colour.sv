// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The pixels of a block, or of some of its rows, from its samples of Y, Co and Cg (COL-2).
//
// BLOCK_LOG2   [1, 3], B = 2^BLOCK_LOG2
// ROWS         [1, B], of the block in a clock
// MAX_DEPTH    [8, 12]; samples have MAX_DEPTH + 1 bits in two's complement
//
// y, co, cg    B * ROWS samples each, (x, y) as number y * B + x; Co and Cg are those that the pixels
//              take (COL-3)
// depth        [8, MAX_DEPTH]
// lanes        R, G and B in [0, 2^depth - 1] in 16 bits each: sample i of lane c at bits
//              16 * (c * B * ROWS + i) on
//
// Latency 2 clocks with advance, ROWS rows a clock: t; R, G and B, each one addition away from t.
// R = B + Co = t - (Co >> 1) + Co is t + (Co >> 1) + 1 with an odd Co, else without the 1. Shifts are floors (CNV-1).
module hmlfc_colour #(
    parameter int BLOCK_LOG2 = 2,
    parameter int ROWS = 1 << BLOCK_LOG2,
    parameter int MAX_DEPTH = 8
) (
    input logic clk,
    input logic advance,
    input logic [(ROWS<<BLOCK_LOG2)*(MAX_DEPTH+1)-1:0] y,
    input logic [(ROWS<<BLOCK_LOG2)*(MAX_DEPTH+1)-1:0] co,
    input logic [(ROWS<<BLOCK_LOG2)*(MAX_DEPTH+1)-1:0] cg,
    input logic [3:0] depth,
    output logic [3*(ROWS<<BLOCK_LOG2)*16-1:0] lanes
);
  localparam integer SAMPLES = ROWS << BLOCK_LOG2;
  localparam integer SAMPLE_BITS = MAX_DEPTH + 1;
  localparam integer SUM_BITS = MAX_DEPTH + 2;  // of t, G, B and R before their clamps

  logic [SUM_BITS-1:0] hi;
  always_ff @(posedge clk) if (advance) hi <= ~({SUM_BITS{1'b1}} << depth);

  // x moved to [0, high], in 16 bits. high is 2^depth - 1: an x that is not negative exceeds it if it has a bit above.
  function automatic [15:0] clamp(input [SUM_BITS-1:0] x, input [SUM_BITS-1:0] high);
    clamp = {{(16 - SUM_BITS) {1'b0}}, x & high};
    if ((x & ~high) != {SUM_BITS{1'b0}}) clamp = {{(16 - SUM_BITS) {1'b0}}, high};
    if (x[SUM_BITS-1]) clamp = 16'd0;
  endfunction

  genvar i;
  generate
    for (i = 0; i < SAMPLES; i = i + 1) begin : gen_pixel
      logic [SAMPLE_BITS-1:0] luma, green_difference, orange_1, green_difference_1;
      logic [SUM_BITS-1:0]    t_1, half_orange_1, red, green, blue;
      assign luma = y[i*SAMPLE_BITS +: SAMPLE_BITS];
      assign green_difference = cg[i*SAMPLE_BITS +: SAMPLE_BITS];

      // x >> 1 of a sample, and the sample itself, in SUM_BITS.
      assign half_orange_1 = {{2{orange_1[SAMPLE_BITS-1]}}, orange_1[SAMPLE_BITS-1:1]};
      assign green = t_1 + {green_difference_1[SAMPLE_BITS-1], green_difference_1};
      assign blue = t_1 - half_orange_1;
      // The 1 enters as the carry of a bit below.
      assign red = SUM_BITS'(({t_1, 1'b1} + {half_orange_1, orange_1[0]}) >> 1);

      always_ff @(posedge clk) begin
        if (advance) begin
          t_1 <= {luma[SAMPLE_BITS-1], luma}
               - {{2{green_difference[SAMPLE_BITS-1]}}, green_difference[SAMPLE_BITS-1:1]};
          orange_1 <= co[i*SAMPLE_BITS +: SAMPLE_BITS];
          green_difference_1 <= green_difference;
          lanes[16*i +: 16] <= clamp(red, hi);
          lanes[16*(SAMPLES+i) +: 16] <= clamp(green, hi);
          lanes[16*(2*SAMPLES+i) +: 16] <= clamp(blue, hi);
        end
      end
    end
  endgenerate
endmodule

`default_nettype wire
