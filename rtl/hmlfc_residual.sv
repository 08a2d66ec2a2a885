// The residuals of a block from its BISE values (TIL-10, STP-3).
//
// BLOCK_LOG2   [1, 3], B = 2^BLOCK_LOG2
// MAX_DEPTH    [8, 12]; values and residuals have MAX_DEPTH + 2 bits, position (x, y) is number
//              y * B + x
//
// values       in [0, N - 1], unsigned
// level_code   [0, 27 + 3 * (depth - 8)]
// bias         [-2^(depth + 1), 2^(depth + 1) - 1], in two's complement
// step_code    [0, 15]; 0 without residual_step
// chroma       the plane is Co or Cg
// depth        [8, MAX_DEPTH]
// residuals    in [-M, M], in two's complement
//
// Latency 2 clocks with advance, one block a clock: centred and clamped; multiplied by the step and
// clamped. The step is 2^k or 3 * 2^k (STP-2): an addition and a shift.
`include "hmlfc_tables.svh"

module hmlfc_residual #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 8
) (
  input  logic                                         clk,
  input  logic                                         advance,
  input  logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+2)-1:0] values,
  input  logic [5:0]                                   level_code,
  input  logic [MAX_DEPTH+1:0]                         bias,
  input  logic [3:0]                                   step_code,
  input  logic                                         chroma,
  input  logic [3:0]                                   depth,
  output logic [(1<<(2*BLOCK_LOG2))*(MAX_DEPTH+2)-1:0] residuals
);
  localparam integer SAMPLES = 1 << (2 * BLOCK_LOG2);
  localparam integer VALUE_BITS = MAX_DEPTH + 2;
  localparam integer SUM_BITS = MAX_DEPTH + 3;       // value - (N >> 1) + bias
  localparam integer PRODUCT_BITS = MAX_DEPTH + 10;  // step * residual

  // M of STR-7.
  logic [SUM_BITS-1:0] largest, bound_next;
  assign largest = ~({SUM_BITS{1'b1}} << depth);
  assign bound_next = chroma ? {largest[SUM_BITS-2:0], 1'b0} : largest;

  // bias - (N >> 1), the same for all positions.
  // Not all bits are used: N >> 1 drops the low bit, a small MAX_DEPTH the high ones.
  logic [14:0] level_count;
  logic [SUM_BITS-1:0] offset;
  assign level_count = hmlfc_level_count(level_code);
  assign offset = {bias[VALUE_BITS-1], bias} - {1'b0, level_count[VALUE_BITS:1]};

  // Code 0: 1; odd k: 2^((k + 1) / 2); even k: 3 * 2^((k - 2) / 2). step_code[3:1] is floor(k / 2).
  logic       thrice_next, thrice;
  logic [3:0] shift_next, shift;
  assign thrice_next = !step_code[0] && step_code != 4'd0;
  assign shift_next = step_code == 4'd0 ? 4'd0
                    : step_code[0] ? {1'b0, step_code[3:1]} + 4'd1 : {1'b0, step_code[3:1]} - 4'd1;

  logic [SUM_BITS-1:0]           bound;
  logic [SAMPLES*VALUE_BITS-1:0] centred_next, centred, residuals_next;

  genvar i;
  generate
    for (i = 0; i < SAMPLES; i = i + 1) begin : gen_sample
      logic [SUM_BITS-1:0] sum;
      assign sum = {1'b0, values[i*VALUE_BITS +: VALUE_BITS]} + offset;
      assign centred_next[i*VALUE_BITS +: VALUE_BITS] =
          $signed(sum) > $signed(bound_next) ? bound_next[VALUE_BITS-1:0] :
          $signed(sum) < -$signed(bound_next) ? -bound_next[VALUE_BITS-1:0] : sum[VALUE_BITS-1:0];

      logic [VALUE_BITS-1:0]   c;
      logic [PRODUCT_BITS-1:0] once, product, limit;
      assign c = centred[i*VALUE_BITS +: VALUE_BITS];
      assign once = {{8{c[VALUE_BITS-1]}}, c};
      assign product = (thrice ? {once[PRODUCT_BITS-2:0], 1'b0} + once : once) << shift;
      assign limit = {7'd0, bound};
      assign residuals_next[i*VALUE_BITS +: VALUE_BITS] =
          $signed(product) > $signed(limit) ? limit[VALUE_BITS-1:0] :
          $signed(product) < -$signed(limit) ? -limit[VALUE_BITS-1:0] : product[VALUE_BITS-1:0];
    end
  endgenerate

  always_ff @(posedge clk) begin
    if (advance) begin
      centred <= centred_next;
      bound <= bound_next;
      thrice <= thrice_next;
      shift <= shift_next;
      residuals <= residuals_next;
    end
  end
endmodule
