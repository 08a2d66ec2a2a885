`include "specification.svh"

// Prediction A and sample are those of the formula in integers of 32 bits, so the rearranged sum equals it and nothing
// overflows, and the sample is in [lo, hi]; three clocks after their input, a block each clock: for every depth 8 to
// 12, both kinds of plane, every state and sign, every parent in [lo, hi], 0 or of a key image, and every reference and
// residual in [-M, M]. MAX_DEPTH = 12; blocks of 4 x 4, each position in a part of its own.
//
// Clauses: DEC-2, DEC-3, EXT-5, STR-7, section 11 (P + sign * ref; A + residual)
// Engine: sat 4
// Parts: 16
// Still: hmlfc_reconstruct advance
// Complete: registers have any values at first, but that the sample before is in [lo, hi], and the register of the
// parent has that sample unless a block is on its way into it; both are proved to stay so. Blocks of one chain are of
// one plane, so depth and plane are constant.
module prove_reconstruct #(parameter integer PART = 0) (
  input logic clk, input logic valid, input logic chained, input logic key, input logic [223:0] references,
      input logic [223:0] residual,
  input logic motion, input logic negative, input logic keyed, input logic has_residual
);
  (* hierconn *) wire [207:0] \dut.parent ;
  (* hierconn *) wire \dut.valid_2 ;
  (* anyconst *) logic chroma;
  (* anyconst *) logic [3:0] depth;
  logic [207:0] prediction, sample;
  hmlfc_reconstruct #(.BLOCK_LOG2(2), .MAX_DEPTH(12)) dut (
    .clk(clk), .advance(1'b1), .valid(valid), .chained(chained), .key(key), .references(references),
    .residual(residual), .motion(motion), .negative(negative), .keyed(keyed), .has_residual(has_residual),
    .chroma(chroma), .depth(depth), .prediction(prediction), .sample(sample));

  wire signed [31:0] hi = (32'd1 << depth) - 1;
  wire signed [31:0] lo = chroma ? -hi : 0;
  wire signed [31:0] bound = hi - lo;
  wire signed [31:0] ref_ = $signed(references[14*PART +: 14]);
  wire signed [31:0] r = $signed(residual[14*PART +: 14]);

  // The block that is two clocks old: its parent is the sample now.
  logic [5:0]         flags_1, flags_2;  // {chained, key, motion, negative, keyed, has_residual}
  logic signed [31:0] ref_1, ref_2, r_1, r_2;
  wire signed [31:0]  s = $signed(sample[13*PART +: 13]);
  wire signed [31:0]  p = flags_2[4] ? ref_2 : flags_2[5] ? s : 0;
  wire signed [31:0]  base = flags_2[1] ? 0 : p;
  wire signed [31:0]  a = flags_2[3] ? spec_clamp(base + (flags_2[2] ? -ref_2 : ref_2), lo, hi) : p;
  wire signed [31:0]  after = flags_2[0] ? spec_clamp(a + r_2, lo, hi) : a;

  logic [1:0]         clocks = 2'd0;
  logic [2:1]         valids;
  logic               came;
  logic signed [31:0] expected, expected_a;
  always @(posedge clk) begin
    if (clocks != 3) clocks <= clocks + 2'd1;
    valids <= {valids[1], valid};
    flags_1 <= {chained, key, motion, negative, keyed, has_residual};
    flags_2 <= flags_1;
    {ref_1, r_1} <= {ref_, r};
    {ref_2, r_2} <= {ref_1, r_1};
    came <= valids[2];
    expected <= valids[2] ? after : s;
    expected_a <= a;
  end
  always @* begin
    assume (depth >= 8 && depth <= 12);
    assume (ref_ >= -bound && ref_ <= bound);
    assume (r >= -bound && r <= bound);
    assume (!(key && motion));
    if (key) assume (ref_ >= lo && ref_ <= hi);
    if (clocks == 0) assume (\dut.parent [13*PART +: 13] == sample[13*PART +: 13] || \dut.valid_2 );
    else assert (\dut.parent [13*PART +: 13] == sample[13*PART +: 13] || \dut.valid_2 );
    if (clocks != 3) assume (s >= lo && s <= hi);
    else begin
      assert (s == expected);
      assert (s >= lo && s <= hi);
      if (came) assert ($signed(prediction[13*PART +: 13]) == expected_a);
    end
  end
endmodule
