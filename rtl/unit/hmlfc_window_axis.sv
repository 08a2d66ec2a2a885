// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Which samples of one axis of a reference plane a window of B + 1 samples from `at` on touches (DEC-5, MOT-9), each
// clamped to [0, size - 1]; without `extra` the last one has weight 0 and is that before it.
//
// size     [1, 16384]
// block    the first block that is touched
// two      the next one is as well
// select   of sample i, its place from the first block's begin on, [0, 2 B - 1]
// Latency 2 clocks with advance: of how far the plane's begin and end are, only what is less than B + 1 counts.
module hmlfc_window_axis #(
    parameter int BLOCK_LOG2 = 2,
    localparam int SIDE = (1 << BLOCK_LOG2) + 1,
    localparam int SELECT_BITS = BLOCK_LOG2 + 1,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS
) (
    input logic clk,
    input logic advance,
    input logic signed [16:0] at,
    input logic [14:0] size,
    input logic extra,
    output logic [BLOCK_BITS-1:0] block,
    output logic two,
    output logic [SIDE*SELECT_BITS-1:0] select
);
  localparam int STEP_BITS = BLOCK_LOG2 + 2;  // in two's complement
  localparam logic signed [17:0] FAR = 18'(SIDE);

  // 1: sample 0, the samples of the window before the plane's begin, and those from sample 0 to the plane's end.
  wire signed [17:0] from_begin = 18'(at);
  wire signed [17:0] to_begin = 18'sd0 - from_begin;
  wire signed [17:0] to_end = $signed({3'd0, size}) - from_begin - 18'sd1;
  logic [14:0] first;
  logic signed [STEP_BITS-1:0] outside, left;
  logic extra_1;
  always_ff @(posedge clk) begin
    if (advance) begin
      first <= at[16] ? '0 : to_end[17] ? size - 15'd1 : at[14:0];
      outside <= !at[16] ? '0 : to_begin > FAR ? STEP_BITS'(SIDE) : to_begin[STEP_BITS-1:0];
      left <= to_end[17] ? '0 : to_end > FAR ? STEP_BITS'(SIDE) : to_end[STEP_BITS-1:0];
      extra_1 <= extra;
    end
  end

  // 2: places. Before the plane's begin there is nothing to its end that counts: `left` is from sample `at` on.
  logic [SIDE*SELECT_BITS-1:0] places;
  always_comb begin
    for (int i = 0; i < SIDE; i++) begin
      logic signed [STEP_BITS-1:0] step;
      step = i == SIDE - 1 && !extra_1 ? STEP_BITS'(i - 1) : STEP_BITS'(i);
      if (step > left) step = left;
      step = step - outside;
      if (step[STEP_BITS-1]) step = '0;
      places[i*SELECT_BITS+:SELECT_BITS] = (first[SELECT_BITS-1:0] & SELECT_BITS'(SIDE - 2)) + SELECT_BITS'(step);
    end
  end
  always_ff @(posedge clk) begin
    if (advance) begin
      block <= BLOCK_BITS'(first >> BLOCK_LOG2);
      two <= places[SIDE*SELECT_BITS-1];
      select <= places;
    end
  end

endmodule

`default_nettype wire
