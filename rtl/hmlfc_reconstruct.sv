// The samples of a block from its parent, prediction reference and residuals (DEC-3, EXT-5).
//
// BLOCK_LOG2   [1, 3], B = 2^BLOCK_LOG2
// MAX_DEPTH    [8, 12]; samples have MAX_DEPTH + 1 bits, references and residuals MAX_DEPTH + 2,
//              all in two's complement, sample (x, y) as number y * B + x
//
// parent         P(x, y), in [lo, hi] or 0
// references     ref(x + dx, y + dy) or R(x, y) of MOT-9, in [-M, M]; used with motion
// residual       in [-M, M]; used with has_residual
// motion         state motion only, or motion and residual
// negative       the sign is -
// keyed          the level is keyed by EXT-5: with motion P = 0. Clear in profile main.
// has_residual   state residual only, or motion and residual
// chroma         the plane is Co or Cg
// depth          [8, MAX_DEPTH]
// prediction     A(x, y)
// sample         sample(x, y), in [lo, hi]
// Combinational.
module hmlfc_reconstruct #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 8
) (
  input  logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+1)-1:0] parent,
  input  logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+2)-1:0] references,
  input  logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+2)-1:0] residual,
  input  logic                                         motion,
  input  logic                                         negative,
  input  logic                                         keyed,
  input  logic                                         has_residual,
  input  logic                                         chroma,
  input  logic [3:0]                                   depth,
  output logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+1)-1:0] prediction,
  output logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+1)-1:0] sample
);
  localparam integer SAMPLES = 1 << (2 * BLOCK_LOG2);
  localparam integer SAMPLE_BITS = MAX_DEPTH + 1;
  localparam integer RESIDUAL_BITS = MAX_DEPTH + 2;
  localparam integer SUM_BITS = MAX_DEPTH + 3;  // of P + sign * ref and of A + residual

  logic [SUM_BITS-1:0] lo, hi;
  assign hi = ~({SUM_BITS{1'b1}} << depth);
  assign lo = chroma ? -hi : {SUM_BITS{1'b0}};

  // x in [lo, hi] fits a sample.
  function automatic [SAMPLE_BITS-1:0] clamp(input [SUM_BITS-1:0] x, input [SUM_BITS-1:0] low,
                                             input [SUM_BITS-1:0] high);
    clamp = x[SAMPLE_BITS-1:0];
    if ($signed(x) < $signed(low)) clamp = low[SAMPLE_BITS-1:0];
    if ($signed(x) > $signed(high)) clamp = high[SAMPLE_BITS-1:0];
  endfunction

  genvar i;
  generate
    for (i = 0; i < SAMPLES; i = i + 1) begin : gen_sample
      logic [SAMPLE_BITS-1:0]   p, a;
      logic [RESIDUAL_BITS-1:0] r, d;
      logic [SUM_BITS-1:0]      base, signed_reference, moved, corrected;
      assign p = parent[i*SAMPLE_BITS +: SAMPLE_BITS];
      assign r = references[i*RESIDUAL_BITS +: RESIDUAL_BITS];
      assign d = residual[i*RESIDUAL_BITS +: RESIDUAL_BITS];

      assign base = keyed ? {SUM_BITS{1'b0}} : {{2{p[SAMPLE_BITS-1]}}, p};
      assign signed_reference = {r[RESIDUAL_BITS-1], r};
      assign moved = negative ? base - signed_reference : base + signed_reference;
      assign a = motion ? clamp(moved, lo, hi) : p;
      assign corrected = {{2{a[SAMPLE_BITS-1]}}, a} + {d[RESIDUAL_BITS-1], d};
      assign prediction[i*SAMPLE_BITS +: SAMPLE_BITS] = a;
      assign sample[i*SAMPLE_BITS +: SAMPLE_BITS] = has_residual ? clamp(corrected, lo, hi) : a;
    end
  endgenerate
endmodule
