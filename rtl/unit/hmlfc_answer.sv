// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Collects the planes of a request and answers it (COL-2, COL-3).
//
// Takes blocks of levels in order. The last of a plane is its result, of a request for residuals `in_residual`, 0
// without `in_has_residual`; with the last plane of a request the answer is made: lanes of 16 bits, status and tlast.
// Chroma of requests for RGB is kept for the next, which may leave it out. Latency 4 clocks.
module hmlfc_answer #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
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

  // COL-3: chroma samples at the pixels' places.
  function automatic logic [PLANE_BITS-1:0] at_pixels(input logic [PLANE_BITS-1:0] plane, input logic [1:0] part,
      input logic full);
    for (int py = 0; py < B; py++) begin
      for (int px = 0; px < B; px++) begin
        int from;
        from = full ? py * B + px : (32'(part[1]) * (B / 2) + py / 2) * B + 32'(part[0]) * (B / 2) + px / 2;
        at_pixels[(py*B+px)*SAMPLE_BITS+:SAMPLE_BITS] = plane[from*SAMPLE_BITS+:SAMPLE_BITS];
      end
    end
  endfunction

  // 1: planes at the pixels; 2 and 3: RGB; then the answer.
  logic advance, advance_out;
  logic [3:1] valid, last, rgb;
  logic [5:0] status_1, status_2, status_3;
  logic [PLANE_BITS-1:0] y_1, co_1, cg_1, y_2, y_3, plane_0;
  // of the samples of a plane, which are as wide as residuals with them
  logic [SAMPLES-1:0] signs_0, signs_1, signs_2, signs_3;
  always_comb begin
    for (int i = 0; i < SAMPLES; i++) begin
      {signs_0[i], plane_0[i*SAMPLE_BITS+:SAMPLE_BITS]} = VALUE_BITS'($signed(in_sample[i*SAMPLE_BITS+:SAMPLE_BITS]));
      if (in_job.residuals)
        {signs_0[i], plane_0[i*SAMPLE_BITS+:SAMPLE_BITS]} = in_has_residual ? in_residual[i*VALUE_BITS+:VALUE_BITS] :
            VALUE_BITS'(0);
    end
  end
  logic [ANSWER_BITS-1:0] lanes_3;
  hmlfc_colour #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .MAX_DEPTH(MAX_DEPTH)
  ) colour (
      .clk,
      .advance,
      .y(y_1),
      .co(co_1),
      .cg(cg_1),
      .depth,
      .lanes(lanes_3)
  );
  assign in_ready = advance;
  assign chroma_spoiled = in_valid && advance && in_job.rgb && in_job.last && !y_now &&
      in_error == HMLFC_ERROR_BUS_ERROR;
  always_ff @(posedge clk) begin
    if (advance) begin
      if (in_valid && in_job.rgb && in_job.last) begin
        unique case (in_job.plane)
          2'd1: {held_co, error_co} <= {in_sample, in_error};
          2'd2: {held_cg, error_cg} <= {in_sample, in_error};
          default: {held_y, error_y, corner} <= {in_sample, in_error, in_job.by[0], in_job.bx[0]};
        endcase
      end
      valid <= {valid[2:1], in_valid && in_job.answer};
      last <= {last[2:1], in_job.tlast};
      rgb <= {rgb[2:1], in_job.rgb};
      status_1 <= in_job.rgb ? rgb_error : in_error;
      y_1 <= in_job.rgb ? y : plane_0;
      co_1 <= at_pixels(held_co, at, chroma_444);
      cg_1 <= at_pixels(cg, at, chroma_444);
      {status_3, status_2} <= {status_2, status_1};
      {y_3, y_2} <= {y_2, y_1};
      {signs_3, signs_2, signs_1} <= {signs_2, signs_1, signs_0};
    end
    if (!rst_n) valid <= '0;
  end

  logic [ANSWER_BITS-1:0] answer;
  always_comb begin
    answer = '0;
    if (status_3 == 0) begin
      if (rgb[3]) answer = lanes_3;
      else for (int i = 0; i < SAMPLES; i++) answer[i*16+:16] =
          16'($signed({signs_3[i], y_3[i*SAMPLE_BITS+:SAMPLE_BITS]}));
    end
  end
  hmlfc_skid_buffer #(
      .WIDTH(ANSWER_BITS + 7)
  ) out (
      .clk,
      .rst_n,
      .in_valid(valid[3]),
      .in_ready(advance_out),
      .in_data({last[3], status_3, answer}),
      .out_valid,
      .out_ready,
      .out_data({out_last, out_error, out_data})
  );
  assign advance = !valid[3] || advance_out;

endmodule

`default_nettype wire
