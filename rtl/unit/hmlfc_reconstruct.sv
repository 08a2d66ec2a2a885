// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The samples of blocks from their parents, prediction references and residuals (DEC-2, DEC-3, EXT-5).
//
// BLOCK_LOG2   [1, 3], B = 2^BLOCK_LOG2
// ROWS         of the block in a clock, a power of two in [1, B]: the block comes in B / ROWS parts, from the top
// MAX_DEPTH    [8, 12]; samples have MAX_DEPTH + 1 bits, references and residuals MAX_DEPTH + 2,
//              all in two's complement, sample (x, y) as number y * B + x
//
// valid          a part comes; what else comes without it does not matter
// chained        the parent P(x, y) is the sample of the block that came before this one; else P = 0
// key            a block of a key image: P(x, y) = ref(x, y), in [lo, hi]; not with motion
// references     ref(x + dx, y + dy) or R(x, y) of MOT-9, in [-M, M]; used with motion or key
// residual       in [-M, M]; used with has_residual
// motion         state motion only, or motion and residual
// negative       the sign is -; used with motion
// keyed          the level is keyed by EXT-5: with motion P = 0. Clear in profile main.
// has_residual   state residual only, or motion and residual
// chroma         the plane is Co or Cg
// depth          [8, MAX_DEPTH]
// prediction     A(x, y) of the block whose last part came before
// sample         sample(x, y), in [lo, hi]
//
// Latency 3 clocks with advance, one part a clock, also where each is the parent of the next. With a = sign * ref,
// or 0 without motion, and r = residual, or 0 without one,
//
//   clamp(clamp(P + a, lo, hi) + r, lo, hi) = clamp(P + t, L, H)
//   with t = a + r, L = lo + max(r, 0) and H = hi + min(r, 0), as |r| <= M = hi - lo,
//
// and P + t < L just if P < L - t: only one addition, beside two comparisons, waits for P. First clock: t, L, H;
// second: L - t, H - t; third: the sample. `prediction` is worked out from registers at the end; it has no part in
// `sample`.
module hmlfc_reconstruct #(
    parameter int BLOCK_LOG2 = 2,
    parameter int ROWS = 1 << BLOCK_LOG2,
    parameter int MAX_DEPTH = 8
) (
    input logic clk,
    input logic advance,
    input logic valid,
    input logic chained,
    input logic key,
    input logic [(ROWS<<BLOCK_LOG2)*(MAX_DEPTH+2)-1:0] references,
    input logic [(ROWS<<BLOCK_LOG2)*(MAX_DEPTH+2)-1:0] residual,
    input logic motion,
    input logic negative,
    input logic keyed,
    input logic has_residual,
    input logic chroma,
    input logic [3:0] depth,
    output logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+1)-1:0] prediction,
    output logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+1)-1:0] sample
);
  localparam integer SAMPLES = ROWS << BLOCK_LOG2;
  localparam integer SAMPLE_BITS = MAX_DEPTH + 1;
  localparam integer PART_BITS = SAMPLES * SAMPLE_BITS;
  localparam integer BLOCK_BITS = SAMPLE_BITS << (2 * BLOCK_LOG2);
  localparam integer RESIDUAL_BITS = MAX_DEPTH + 2;
  localparam integer SUM_BITS = MAX_DEPTH + 3;  // of a + r, L - t, H - t, and P less these

  // The interval of samples.
  logic signed [SAMPLE_BITS-1:0] hi, lo, hi_1, lo_1, hi_2, lo_2, hi_3, lo_3;
  logic                          valid_1, valid_2, chained_1;
  assign hi = ~({SAMPLE_BITS{1'b1}} << depth);
  assign lo = chroma ? -hi : {SAMPLE_BITS{1'b0}};

  always_ff @(posedge clk) begin
    if (advance) begin
      valid_1 <= valid;
      valid_2 <= valid_1;
      chained_1 <= chained && !key && !(keyed && motion);
      {hi_1, lo_1} <= {hi, lo};
      {hi_2, lo_2} <= {hi_1, lo_1};
      if (valid_2) {hi_3, lo_3} <= {hi_2, lo_2};
    end
  end

  // P of the part that is in its third clock: the same part of the block before, or 0 where it is not chained to it.
  // `sample` moves up by a part with each: the oldest part is below.
  logic                  begins;
  logic [PART_BITS-1:0]  parent, after, predicted;
  logic [BLOCK_BITS-1:0] moved_up;
  assign begins = valid_1 && !chained_1;
  assign moved_up = BLOCK_BITS'({after, sample} >> PART_BITS);
  always_ff @(posedge clk) begin
    if (advance) begin
      if (begins) parent <= {PART_BITS{1'b0}};
      else if (valid_2) parent <= moved_up[PART_BITS-1:0];
      else if (PART_BITS < BLOCK_BITS) parent <= sample[PART_BITS-1:0];
      if (valid_2) sample <= moved_up;
    end
  end

  genvar i;
  generate
    for (i = 0; i < SAMPLES; i = i + 1) begin : gen_sample
      // First clock. The 1 that negates ref enters as the carry of a bit below.
      logic                            minus;
      logic signed [RESIDUAL_BITS-1:0] moved, r, r_up, r_down;  // a, less 1 with minus; r; max(r, 0); min(r, 0)
      logic signed [RESIDUAL_BITS:0]   moved_carry, r_carry;
      logic signed [SUM_BITS:0]        t_carry;
      assign minus = motion && negative;
      assign moved = (references[i*RESIDUAL_BITS +: RESIDUAL_BITS] ^ {RESIDUAL_BITS{minus}})
                   & {RESIDUAL_BITS{motion || key}};
      assign r = residual[i*RESIDUAL_BITS +: RESIDUAL_BITS] & {RESIDUAL_BITS{has_residual}};
      assign r_up = r & {RESIDUAL_BITS{!r[RESIDUAL_BITS-1]}};
      assign r_down = r & {RESIDUAL_BITS{r[RESIDUAL_BITS-1]}};
      assign moved_carry = {moved, 1'b1};
      assign r_carry = {r, minus};
      assign t_carry = moved_carry + r_carry;

      // Second and third clock.
      logic signed [SUM_BITS-1:0]      t_1, t_2, below, above;  // P < below, P > above: P + t leaves [L, H]
      logic signed [SAMPLE_BITS-1:0]   least_1, least_2, most_1, most_2;  // L, H
      logic signed [SAMPLE_BITS-1:0]   p;
      logic signed [SUM_BITS-1:0]      sum, over_least, over_most;
      assign p = parent[i*SAMPLE_BITS +: SAMPLE_BITS];
      assign sum = SUM_BITS'(p) + t_2;
      assign over_least = SUM_BITS'(p) - below;
      assign over_most = above - SUM_BITS'(p);
      assign after[i*SAMPLE_BITS +: SAMPLE_BITS] = over_least[SUM_BITS-1] ? least_2
                                                 : over_most[SUM_BITS-1] ? most_2 : sum[SAMPLE_BITS-1:0];

      always_ff @(posedge clk) begin
        if (advance) begin
          t_1 <= t_carry[SUM_BITS:1];
          least_1 <= SAMPLE_BITS'(RESIDUAL_BITS'(lo) + r_up);
          most_1 <= SAMPLE_BITS'(RESIDUAL_BITS'(hi) + r_down);
          t_2 <= t_1;
          least_2 <= least_1;
          most_2 <= most_1;
          below <= SUM_BITS'(least_1) - t_1;
          above <= SUM_BITS'(most_1) - t_1;
        end
      end

      // A = clamp(P + a, lo, hi), beside.
      logic signed [SAMPLE_BITS-1:0]   p_3;
      logic signed [RESIDUAL_BITS-1:0] a_1, a_2, a_3;
      logic signed [SUM_BITS-1:0]      a_below, a_above, a_sum, a_over_lo, a_over_hi;
      assign a_sum = SUM_BITS'(p_3) + SUM_BITS'(a_3);
      assign a_over_lo = SUM_BITS'(p_3) - a_below;
      assign a_over_hi = a_above - SUM_BITS'(p_3);
      assign predicted[i*SAMPLE_BITS +: SAMPLE_BITS] = a_over_lo[SUM_BITS-1] ? lo_3
                                                     : a_over_hi[SUM_BITS-1] ? hi_3 : a_sum[SAMPLE_BITS-1:0];
      always_ff @(posedge clk) begin
        if (advance) begin
          a_1 <= minus ? -references[i*RESIDUAL_BITS +: RESIDUAL_BITS] : moved;
          a_2 <= a_1;
          if (valid_2) begin
            p_3 <= p;
            a_3 <= a_2;
            a_below <= SUM_BITS'(lo_2) - SUM_BITS'(a_2);
            a_above <= SUM_BITS'(hi_2) - SUM_BITS'(a_2);
          end
        end
      end
    end

    if (PART_BITS == BLOCK_BITS) begin : gen_block
      assign prediction = predicted;
    end else begin : gen_parts
      logic [BLOCK_BITS-PART_BITS-1:0] earlier;
      assign prediction = {predicted, earlier};
      always_ff @(posedge clk) if (advance && valid_2) earlier <= prediction[BLOCK_BITS-1:PART_BITS];
    end
  endgenerate
endmodule

`default_nettype wire
