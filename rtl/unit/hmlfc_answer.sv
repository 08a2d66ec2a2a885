// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Collects the planes of a request and answers it (COL-2, COL-3).
//
// Takes blocks of levels in order. The last of a plane is its result, of a request for residuals `in_residual`, 0
// without `in_has_residual`; with the last plane of a request the answer is made: lanes of 16 bits, status and tlast.
// Chroma of requests for RGB is kept for the next, which may leave it out. A block takes CLOCKS clocks, from its upper
// rows on. Latency 3 clocks behind its last, 4 with CLOCKS = 1.
module hmlfc_answer #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int CLOCKS = 1,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int SAMPLE_BITS = MAX_DEPTH + 1,
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int PLANE_BITS = SAMPLES * SAMPLE_BITS,
    localparam int ANSWER_BITS = 3 * SAMPLES * 16
) (
    input logic clk,
    input logic rst_n,
    input logic [3:0] depth,
    input logic chroma_444,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::job_t in_job,
    input logic [5:0] in_error,
    input logic [PLANE_BITS-1:0] in_sample,
    input logic in_has_residual,
    input logic [SAMPLES*VALUE_BITS-1:0] in_residual,

    output logic chroma_spoiled,  // the chroma that is kept met a bus error: it is not to be relied on

    output logic out_valid,
    input logic out_ready,
    output logic [ANSWER_BITS-1:0] out_data,
    output logic [5:0] out_error,
    output logic out_last
);

  localparam int B = 1 << BLOCK_LOG2;
  localparam int ROWS = B / CLOCKS;
  localparam int PART_BITS = $clog2(CLOCKS) > 0 ? $clog2(CLOCKS) : 1;
  localparam int PART_SAMPLES = SAMPLES / CLOCKS;

  logic [PLANE_BITS-1:0] held_y, held_co, held_cg;
  logic [5:0] error_y, error_co, error_cg;
  logic [1:0] corner;  // of the pixels in their chroma block, by the parity of their block

  // With the last block of a request, its planes: what is held, and what comes now.
  wire y_now = in_job.plane == 2'd0;
  wire cg_now = in_job.plane == 2'd2;
  wire [PLANE_BITS-1:0] y = y_now ? in_sample : held_y;
  wire [PLANE_BITS-1:0] cg = cg_now ? in_sample : held_cg;
  wire [5:0] y_error = y_now ? in_error : error_y;
  wire [5:0] cg_error = cg_now ? in_error : error_cg;
  wire [1:0] at = y_now ? {in_job.by[0], in_job.bx[0]} : corner;
  wire [5:0] rgb_error = y_error != 0 ? y_error : error_co != 0 ? error_co : cg_error;

  // The part of the block that comes: ROWS rows of it.
  logic [PART_BITS-1:0] part;
  wire final_part = CLOCKS == 1 || part == PART_BITS'(CLOCKS - 1);

  // COL-3: chroma samples at the places of the part's pixels.
  function automatic logic [PART_SAMPLES*SAMPLE_BITS-1:0] at_pixels(input logic [PLANE_BITS-1:0] plane,
      input logic [PART_BITS-1:0] number, input logic [1:0] quarter, input logic full);
    logic [BLOCK_LOG2-1:0] of_block, from;
    logic [B*SAMPLE_BITS-1:0] row;
    for (int py = 0; py < ROWS; py++) begin
      of_block = BLOCK_LOG2'((CLOCKS == 1 ? 0 : 32'(number) * ROWS) + py);
      from = full ? of_block : (of_block >> 1) | (BLOCK_LOG2'(quarter[1]) << (BLOCK_LOG2 - 1));
      row = '0;
      for (int r = 0; r < B; r++) if (from == BLOCK_LOG2'(r)) row = plane[r*B*SAMPLE_BITS+:B*SAMPLE_BITS];
      for (int px = 0; px < B; px++) begin
        at_pixels[(py*B+px)*SAMPLE_BITS+:SAMPLE_BITS] = full ? row[px*SAMPLE_BITS+:SAMPLE_BITS] :
            quarter[0] ? row[(B/2+px/2)*SAMPLE_BITS+:SAMPLE_BITS] : row[(px/2)*SAMPLE_BITS+:SAMPLE_BITS];
      end
    end
  endfunction

  // 1: planes at the pixels; 2 and 3: RGB; then the answer.
  localparam int VALUES = PART_SAMPLES * VALUE_BITS;
  logic advance, advance_out;
  logic [3:1] valid, last, rgb, ends;
  logic [5:0] status_1, status_2, status_3;
  logic [PART_SAMPLES*SAMPLE_BITS-1:0] y_0, y_1, co_1, cg_1, y_2, y_3;
  // of the samples of a plane, which are as wide as residuals with them
  logic [PART_SAMPLES-1:0] signs_0, signs_1, signs_2, signs_3;
  logic [PART_SAMPLES*SAMPLE_BITS-1:0] sample_0, rgb_0;
  logic [VALUES-1:0] residual_0;
  always_comb begin
    {sample_0, rgb_0, residual_0} = '0;
    for (int p = 0; p < CLOCKS; p++) begin
      if (CLOCKS == 1 || part == PART_BITS'(p)) begin
        sample_0 = in_sample[p*PART_SAMPLES*SAMPLE_BITS+:PART_SAMPLES*SAMPLE_BITS];
        rgb_0 = y[p*PART_SAMPLES*SAMPLE_BITS+:PART_SAMPLES*SAMPLE_BITS];
        residual_0 = in_residual[p*VALUES+:VALUES] & {VALUES{in_has_residual}};
      end
    end
    for (int i = 0; i < PART_SAMPLES; i++) begin
      {signs_0[i], y_0[i*SAMPLE_BITS+:SAMPLE_BITS]} = in_job.residuals ? residual_0[i*VALUE_BITS+:VALUE_BITS] :
          VALUE_BITS'($signed(sample_0[i*SAMPLE_BITS+:SAMPLE_BITS]));
    end
  end
  logic [3*PART_SAMPLES*16-1:0] lanes_3;
  hmlfc_colour #(.BLOCK_LOG2(BLOCK_LOG2), .ROWS(ROWS), .MAX_DEPTH(MAX_DEPTH)) colour (
      .clk, .advance, .y(y_1), .co(co_1), .cg(cg_1), .depth, .lanes(lanes_3)
  );
  assign in_ready = advance && final_part;
  assign chroma_spoiled = in_valid && in_ready && in_job.rgb && in_job.last && !y_now &&
      in_error == HMLFC_ERROR_BUS_ERROR;
  always_ff @(posedge clk) begin
    if (advance) begin
      if (in_valid && final_part && in_job.rgb && in_job.last) begin
        unique case (in_job.plane)
          2'd1: {held_co, error_co} <= {in_sample, in_error};
          2'd2: {held_cg, error_cg} <= {in_sample, in_error};
          default: {held_y, error_y, corner} <= {in_sample, in_error, in_job.by[0], in_job.bx[0]};
        endcase
      end
      valid <= {valid[2:1], in_valid && in_job.answer};
      last <= {last[2:1], in_job.tlast};
      rgb <= {rgb[2:1], in_job.rgb};
      ends <= {ends[2:1], final_part};
      status_1 <= in_job.rgb ? rgb_error : in_error;
      y_1 <= in_job.rgb ? rgb_0 : y_0;
      co_1 <= at_pixels(held_co, part, at, chroma_444);
      cg_1 <= at_pixels(cg, part, at, chroma_444);
      {status_3, status_2} <= {status_2, status_1};
      {y_3, y_2} <= {y_2, y_1};
      {signs_3, signs_2, signs_1} <= {signs_2, signs_1, signs_0};
    end
    if (!rst_n || (advance && (final_part || !in_valid))) part <= '0;
    else if (advance) part <= part + 1'b1;
    if (!rst_n) valid <= '0;
  end
  assign advance = !valid[3] || advance_out;

  logic [3*PART_SAMPLES*16-1:0] answer;
  always_comb begin
    answer = '0;
    if (status_3 == 0) begin
      if (rgb[3]) answer = lanes_3;
      else for (int i = 0; i < PART_SAMPLES; i++) answer[i*16+:16] =
          16'($signed({signs_3[i], y_3[i*SAMPLE_BITS+:SAMPLE_BITS]}));
    end
  end
  wire whole = valid[3] && (CLOCKS == 1 || ends[3]);
  if (CLOCKS == 1) begin : g_block
    hmlfc_skid_buffer #(.WIDTH(ANSWER_BITS + 7)) out (
        .clk, .rst_n, .in_valid(whole), .in_ready(advance_out), .in_data({last[3], status_3, answer}), .out_valid,
        .out_ready, .out_data({out_last, out_error, out_data})
    );
  end else begin : g_parts
    // The parts of each lane gather where they leave, those of the next block a clock after this one has left.
    localparam int LANE = SAMPLES * 16;
    localparam int PART = PART_SAMPLES * 16;
    assign advance_out = !out_valid;
    always_ff @(posedge clk) begin
      if (valid[3] && advance_out) begin
        {out_last, out_error} <= {last[3], status_3};
        for (int c = 0; c < 3; c++) begin
          out_data[c*LANE+:LANE] <= LANE'({answer[c*PART+:PART], out_data[c*LANE+:LANE]} >> PART);
        end
      end
      out_valid <= rst_n && (out_valid ? !out_ready : whole);
    end
  end

endmodule

`default_nettype wire
