// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The prediction reference R of a block, or of some of its rows, from one or two references (MOT-9).
//
// BLOCK_LOG2    [1, 3], B = 2^BLOCK_LOG2
// ROWS          [1, B], of the block in a clock
// SAMPLE_BITS   of a sample of ref, in two's complement: MAX_DEPTH + 2
//
// window_a, window_b   (B + 1) x (ROWS + 1) samples of the first and the second reference, from
//                      (ix, iy) on: sample (x, y) at bits SAMPLE_BITS * (y * (B + 1) + x) on.
//                      A sample whose weight is 0 does not matter.
// fx_*, fy_*           eighths of a sample, [0, 7]
// two                  use both; else window_b, fx_b and fy_b do not matter
// prediction           R(x, y) at bits SAMPLE_BITS * (y * B + x) on
//
// Latency 3 clocks with advance, ROWS rows a clock: along rows, along columns, rounding. Nothing is rounded before the
// end.
module hmlfc_interpolate #(
    parameter int BLOCK_LOG2 = 2,
    parameter int ROWS = 1 << BLOCK_LOG2,
    parameter int SAMPLE_BITS = 10
) (
    input logic clk,
    input logic advance,
    input logic [(ROWS+1)*((1<<BLOCK_LOG2)+1)*SAMPLE_BITS-1:0] window_a,
    input logic [(ROWS+1)*((1<<BLOCK_LOG2)+1)*SAMPLE_BITS-1:0] window_b,
    input logic [2:0] fx_a,
    input logic [2:0] fy_a,
    input logic [2:0] fx_b,
    input logic [2:0] fy_b,
    input logic two,
    output logic [(ROWS<<BLOCK_LOG2)*SAMPLE_BITS-1:0] prediction
);
  localparam integer B = 1 << BLOCK_LOG2;
  localparam integer SIDE = B + 1;
  localparam integer WINDOW = (ROWS + 1) * SIDE * SAMPLE_BITS;
  localparam integer ROW_BITS = SAMPLE_BITS + 3;   // 8 times a sample
  localparam integer SUM_BITS = SAMPLE_BITS + 6;   // 64 times
  localparam integer TOTAL_BITS = SAMPLE_BITS + 7; // 128 times

  // Both references one above the other, the first below.
  logic [2*WINDOW-1:0]              windows;
  logic [5:0]                       fx, fy;
  logic [2*(ROWS+1)*B*ROW_BITS-1:0] rows_next, rows;
  logic [2*ROWS*B*SUM_BITS-1:0]     sums_next, sums;
  logic [ROWS*B*SAMPLE_BITS-1:0]    prediction_next;
  logic [5:0]                       fy_rows;
  logic                             two_rows, two_sums;

  assign windows = {window_b, window_a};
  assign fx = {fx_b, fx_a};
  assign fy = {fy_b, fy_a};

  genvar r, x, y;
  generate
    for (r = 0; r < 2; r = r + 1) begin : gen_reference
      for (x = 0; x < B; x = x + 1) begin : gen_column
        for (y = 0; y <= ROWS; y = y + 1) begin : gen_along_row
          localparam integer AT = r * WINDOW + (y * SIDE + x) * SAMPLE_BITS;
          hmlfc_between #(.SAMPLE_BITS(SAMPLE_BITS)) between (
              .first(windows[AT +: SAMPLE_BITS]), .second(windows[AT + SAMPLE_BITS +: SAMPLE_BITS]),
              .eighths(fx[3*r +: 3]), .value(rows_next[((r*(ROWS+1)+y)*B+x)*ROW_BITS +: ROW_BITS])
          );
        end
        for (y = 0; y < ROWS; y = y + 1) begin : gen_along_column
          hmlfc_between #(.SAMPLE_BITS(ROW_BITS)) between (
              .first(rows[((r*(ROWS+1)+y)*B+x)*ROW_BITS +: ROW_BITS]),
              .second(rows[((r*(ROWS+1)+y+1)*B+x)*ROW_BITS +: ROW_BITS]), .eighths(fy_rows[3*r +: 3]),
              .value(sums_next[((r*ROWS+y)*B+x)*SUM_BITS +: SUM_BITS])
          );
        end
      end
    end

    // (I + 32) >> 6 is (I + I + 64) >> 7.
    for (x = 0; x < ROWS * B; x = x + 1) begin : gen_round
      logic [SUM_BITS-1:0]   first, second;
      // Not all bits are used: the shift drops the low bits.
      logic [TOTAL_BITS-1:0] total;
      assign first = sums[x*SUM_BITS +: SUM_BITS];
      assign second = two_sums ? sums[(ROWS*B+x)*SUM_BITS +: SUM_BITS] : first;
      assign total = {first[SUM_BITS-1], first} + {second[SUM_BITS-1], second} + TOTAL_BITS'(64);
      assign prediction_next[x*SAMPLE_BITS +: SAMPLE_BITS] = total[7 +: SAMPLE_BITS];
    end
  endgenerate

  always_ff @(posedge clk) begin
    if (advance) begin
      rows <= rows_next;
      fy_rows <= fy;
      two_rows <= two;
      sums <= sums_next;
      two_sums <= two_rows;
      prediction <= prediction_next;
    end
  end
endmodule

`default_nettype wire
