// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Makes the samples of each block from its parent, references and residual (DEC-2, DEC-3, DEC-6, MOT-9), one block in
// CLOCKS clocks, from its upper rows on.
//
// Takes blocks in order, and for each the windows it requested, each in CLOCKS parts as hmlfc_reference_lines gives
// them. The result of one level is the parent of the next.
// Latency 6 clocks behind the last part. `out_error` is the first error of the levels so far (CNV-7, DEC-7).
module hmlfc_compose #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int CLOCKS = 1,
    parameter int TRACE = 1,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int ROWS = (1 << BLOCK_LOG2) / CLOCKS,
    localparam int SIDE = (1 << BLOCK_LOG2) + 1,
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int SAMPLE_BITS = MAX_DEPTH + 1,
    localparam int WINDOW_BITS = (ROWS + 1) * SIDE * VALUE_BITS,
    localparam int PENDING_BITS = hmlfc_pkg::PENDING_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic [3:0] depth,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::pending_t in_pending,
    input logic [SAMPLES*VALUE_BITS-1:0] in_residual,

    input logic a_valid,
    output logic a_ready,
    input logic [5:0] a_error,
    input logic [WINDOW_BITS-1:0] a_window,
    input logic b_valid,
    output logic b_ready,
    input logic [5:0] b_error,
    input logic [WINDOW_BITS-1:0] b_window,

    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::pending_t out_pending,
    output logic [5:0] out_error,
    output logic [SAMPLES*SAMPLE_BITS-1:0] out_sample,
    output logic [SAMPLES*VALUE_BITS-1:0] out_residual,
    // Stages of the block, for traces; 0 without TRACE.
    output logic [SAMPLES*VALUE_BITS-1:0] out_reference,
    output logic [SAMPLES*SAMPLE_BITS-1:0] out_prediction
);

  localparam int PART_BITS = $clog2(CLOCKS) > 0 ? $clog2(CLOCKS) : 1;
  localparam int BLOCK_VALUES = SAMPLES * VALUE_BITS;
  localparam int PART_VALUES = BLOCK_VALUES / CLOCKS;

  // Windows. Where both come through B, the first is kept until the second arrives.
  logic [PART_BITS-1:0] part;  // that is kept, or goes
  wire last = CLOCKS == 1 || part == PART_BITS'(CLOCKS - 1);
  wire needs_first = in_pending.key || in_pending.motion;
  wire both_from_b = in_pending.two && in_pending.first_from_b;
  logic kept_valid;
  logic [5:0] kept_error;
  logic [CLOCKS*WINDOW_BITS-1:0] kept_window;  // the next part below
  wire keep = in_valid && both_from_b && !kept_valid && b_valid;
  wire first_there = both_from_b ? kept_valid : !needs_first || (in_pending.first_from_b ? b_valid : a_valid);
  wire second_there = !in_pending.two || b_valid;

  logic advance;
  wire complete = in_valid && first_there && second_there;
  wire go = complete && advance;
  assign in_ready = first_there && second_there && advance && last;
  assign a_ready = go && needs_first && !in_pending.first_from_b;
  assign b_ready = keep || (go && (in_pending.two || (needs_first && in_pending.first_from_b)));
  always_ff @(posedge clk) begin
    if (keep) kept_error <= b_error;
    if (keep || (go && CLOCKS > 1)) kept_window <= (CLOCKS * WINDOW_BITS)'({b_window, kept_window} >> WINDOW_BITS);
    if (!rst_n || (go && last)) kept_valid <= 1'b0;
    else if (keep && last) kept_valid <= 1'b1;
    if (!rst_n || ((keep || go) && last)) part <= '0;
    else if (keep || go) part <= part + 1'b1;
  end
  wire [WINDOW_BITS-1:0] first_window = both_from_b ? kept_window[WINDOW_BITS-1:0] :
      in_pending.first_from_b ? b_window : a_window;
  wire [5:0] first_error = both_from_b ? kept_error : in_pending.first_from_b ? b_error : a_error;
  wire [5:0] error_0 = in_pending.job.error != 0 ? in_pending.job.error :
      needs_first && first_error != 0 ? first_error :
      in_pending.two ? b_error : 6'd0;

  logic [PART_VALUES-1:0] residual_0;
  always_comb begin
    residual_0 = '0;
    for (int i = 0; i < CLOCKS; i++) begin
      if (CLOCKS == 1 || part == PART_BITS'(i)) residual_0 = in_residual[i*PART_VALUES+:PART_VALUES];
    end
  end

  // Stages 1 to 4: interpolation; windows are taken over in stage 1. Stages 5 to 7: the sum, on top of the level
  // before. In the last the parts of a block gather, which `ends` with its last.
  localparam int STAGES = 7;
  logic [STAGES:1] valid, lasts;
  wire ends = CLOCKS == 1 || lasts[STAGES];
  logic [STAGES*PENDING_BITS-1:0] pendings;
  logic [STAGES*6-1:0] errors;
  logic [(STAGES-1)*PART_VALUES+BLOCK_VALUES-1:0] residuals;
  logic [WINDOW_BITS-1:0] window_a, window_b;
  hmlfc_pkg::pending_t pending_1, pending_4, pending_6;
  assign pending_1 = pendings[0+:PENDING_BITS];
  assign pending_4 = pendings[3*PENDING_BITS+:PENDING_BITS];
  assign pending_6 = pendings[5*PENDING_BITS+:PENDING_BITS];
  logic [PART_VALUES-1:0] reference_4;
  hmlfc_interpolate #(.BLOCK_LOG2(BLOCK_LOG2), .ROWS(ROWS), .SAMPLE_BITS(VALUE_BITS)) interpolate (
      .clk, .advance, .window_a, .window_b, .fx_a(pending_1.fx_a), .fy_a(pending_1.fy_a), .fx_b(pending_1.fx_b),
      .fy_b(pending_1.fy_b), .two(pending_1.two), .prediction(reference_4)
  );
  logic [SAMPLES*SAMPLE_BITS-1:0] prediction_7;
  hmlfc_reconstruct #(.BLOCK_LOG2(BLOCK_LOG2), .ROWS(ROWS), .MAX_DEPTH(MAX_DEPTH)) reconstruct (
      .clk, .advance, .valid(valid[4]), .chained(!pending_4.job.first), .key(pending_4.key), .references(reference_4),
      .residual(residuals[3*PART_VALUES+:PART_VALUES]), .motion(pending_4.motion), .negative(pending_4.negative),
      .keyed(pending_4.base_zero), .has_residual(pending_4.has_residual), .chroma(pending_4.job.plane != 2'd0), .depth,
      .prediction(prediction_7), .sample(out_sample)
  );

  logic [5:0] chain_error;
  wire [5:0] error_6 = !pending_6.job.first && chain_error != 0 ? chain_error : errors[5*6+:6];
  assign advance = !(valid[STAGES] && ends) || out_ready;
  wire gather = valid[STAGES-1] || CLOCKS == 1;
  wire [BLOCK_VALUES-1:0] residual_7 = residuals[(STAGES-1)*PART_VALUES+:BLOCK_VALUES];
  always_ff @(posedge clk) begin
    if (advance) begin
      valid <= {valid[STAGES-1:1], go};
      lasts <= {lasts[STAGES-1:1], last};
      pendings <= {pendings[(STAGES-1)*PENDING_BITS-1:0], in_pending};
      errors <= {error_6, errors[5*6-1:0], error_0};
      residuals[(STAGES-1)*PART_VALUES-1:0] <= {residuals[(STAGES-2)*PART_VALUES-1:0], residual_0};
      if (gather) begin
        residuals[(STAGES-1)*PART_VALUES+:BLOCK_VALUES] <=
            BLOCK_VALUES'({residuals[(STAGES-2)*PART_VALUES+:PART_VALUES], residual_7} >> PART_VALUES);
      end
      window_a <= first_window;
      window_b <= b_window;
      if (valid[6]) chain_error <= error_6;
    end
    if (!rst_n) valid <= '0;
  end
  assign out_valid = valid[STAGES] && ends;
  assign out_pending = pendings[(STAGES-1)*PENDING_BITS+:PENDING_BITS];
  assign out_error = errors[(STAGES-1)*6+:6];

  assign out_residual = residual_7;

  // References of stages 5 to 7.
  if (TRACE != 0) begin : g_trace
    logic [2*PART_VALUES-1:0] stages;
    always_ff @(posedge clk) begin
      if (advance) begin
        stages <= {stages[PART_VALUES-1:0], reference_4};
        if (gather) out_reference <= BLOCK_VALUES'({stages[PART_VALUES+:PART_VALUES], out_reference} >> PART_VALUES);
      end
    end
    assign out_prediction = prediction_7;
  end else begin : g_no_trace
    assign {out_reference, out_prediction} = '0;
  end

endmodule

`default_nettype wire
