// The pixels of a block from its samples of Y, Co and Cg (COL-2).
//
// BLOCK_LOG2   [1, 3], B = 2^BLOCK_LOG2
// MAX_DEPTH    [8, 12]; samples have MAX_DEPTH + 1 bits in two's complement
//
// y, co, cg    B * B samples each, (x, y) as number y * B + x; Co and Cg are those that the pixels
//              take (COL-3)
// depth        [8, MAX_DEPTH]
// lanes        R, G and B in [0, 2^depth - 1] in 16 bits each: sample i of lane c at bits
//              16 * (c * B * B + i) on
//
// Latency 1 clock with advance, one block a clock.
module hmlfc_colour #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 8
) (
  input  logic                                         clk,
  input  logic                                         advance,
  input  logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+1)-1:0] y,
  input  logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+1)-1:0] co,
  input  logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+1)-1:0] cg,
  input  logic [3:0]                                   depth,
  output logic [3*(1<<(2*BLOCK_LOG2))*16-1:0]          lanes
);
  localparam integer SAMPLES = 1 << (2 * BLOCK_LOG2);
  localparam integer SAMPLE_BITS = MAX_DEPTH + 1;
  localparam integer SUM_BITS = MAX_DEPTH + 2;  // of t, G, B and R before their clamps

  logic [SUM_BITS-1:0] hi;
  assign hi = ~({SUM_BITS{1'b1}} << depth);

  // x moved to [0, high], in 16 bits.
  function automatic [15:0] clamp(input [SUM_BITS-1:0] x, input [SUM_BITS-1:0] high);
    clamp = {{(16 - SUM_BITS) {1'b0}}, x};
    if ($signed(x) > $signed(high)) clamp = {{(16 - SUM_BITS) {1'b0}}, high};
    if (x[SUM_BITS-1]) clamp = 16'd0;
  endfunction

  logic [3*SAMPLES*16-1:0] lanes_next;

  genvar i;
  generate
    for (i = 0; i < SAMPLES; i = i + 1) begin : gen_pixel
      logic [SAMPLE_BITS-1:0] luma, orange, green_difference;
      logic [SUM_BITS-1:0]    t, red, green, blue;
      assign luma = y[i*SAMPLE_BITS +: SAMPLE_BITS];
      assign orange = co[i*SAMPLE_BITS +: SAMPLE_BITS];
      assign green_difference = cg[i*SAMPLE_BITS +: SAMPLE_BITS];

      // x >> 1 of a sample, and the sample itself, in SUM_BITS.
      assign t = {luma[SAMPLE_BITS-1], luma}
               - {{2{green_difference[SAMPLE_BITS-1]}}, green_difference[SAMPLE_BITS-1:1]};
      assign green = t + {green_difference[SAMPLE_BITS-1], green_difference};
      assign blue = t - {{2{orange[SAMPLE_BITS-1]}}, orange[SAMPLE_BITS-1:1]};
      assign red = blue + {orange[SAMPLE_BITS-1], orange};

      assign lanes_next[16*i +: 16] = clamp(red, hi);
      assign lanes_next[16*(SAMPLES+i) +: 16] = clamp(green, hi);
      assign lanes_next[16*(2*SAMPLES+i) +: 16] = clamp(blue, hi);
    end
  endgenerate

  always_ff @(posedge clk) begin
    if (advance) lanes <= lanes_next;
  end
endmodule
