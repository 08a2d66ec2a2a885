/// hmlfc_checker.sv at the pins of hmlfc_decode_unit, by bind: nothing in the unit changes. An example for
/// a unit of your own. Without +hmlfc_checker_stream=FILE it checks nothing.
module hmlfc_checker_bind #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int SAMPLE_BITS = MAX_DEPTH + 1
) (
    input logic clk,
    input logic rst_n,
    input logic s_request_tvalid,
    input logic s_request_tready,
    input logic [59:0] request,
    input logic m_response_tvalid,
    input logic m_response_tready,
    input logic [3*SAMPLES*16-1:0] m_response_tdata,
    input logic [5:0] m_response_tuser,
    input logic trace_valid,
    input logic [3:0] trace_level,
    input logic [1:0] trace_plane,
    input logic [14:0] trace_bx,
    input logic [14:0] trace_by,
    input logic [11:0] trace_row,
    input logic [11:0] trace_col,
    input logic trace_key,
    input logic trace_motion,
    input logic trace_has_residual,
    input logic [SAMPLES*VALUE_BITS-1:0] trace_residual,
    input logic [SAMPLES*VALUE_BITS-1:0] trace_reference,
    input logic [SAMPLES*SAMPLE_BITS-1:0] trace_prediction,
    input logic [SAMPLES*SAMPLE_BITS-1:0] trace_sample,
    input logic [5:0] trace_error
);

  // The values of the trace with 16 bits each.
  logic [SAMPLES*16-1:0] residual, reference, prediction, sample;
  for (genvar i = 0; i < SAMPLES; i++) begin : gen_extend
    assign residual[i*16+:16] = 16'($signed(trace_residual[i*VALUE_BITS+:VALUE_BITS]));
    assign reference[i*16+:16] = 16'($signed(trace_reference[i*VALUE_BITS+:VALUE_BITS]));
    assign prediction[i*16+:16] = 16'($signed(trace_prediction[i*SAMPLE_BITS+:SAMPLE_BITS]));
    assign sample[i*16+:16] = 16'($signed(trace_sample[i*SAMPLE_BITS+:SAMPLE_BITS]));
  end

  hmlfc_checker #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .OPTIONAL(1)
  ) model_check (
      .clk,
      .rst_n,
      .request_valid(s_request_tvalid),
      .request_ready(s_request_tready),
      .request_row(request[11:0]),
      .request_col(request[23:12]),
      .request_plane(request[55:54]),
      .request_block_x(request[38:24]),
      .request_block_y(request[53:39]),
      .request_stop_level(request[59:56]),
      .request_tag(16'd0),
      .answer_valid(m_response_tvalid),
      .answer_ready(m_response_tready),
      .answer_tag(16'd0),
      .answer_status(m_response_tuser),
      .answer_samples(m_response_tdata),
      .stage_valid(trace_valid),
      .stage_level(trace_level),
      .stage_row(trace_row),
      .stage_col(trace_col),
      .stage_plane(trace_plane),
      .stage_block_x(trace_bx),
      .stage_block_y(trace_by),
      .stage_error(trace_error),
      .stage_shown({1'b1, !trace_key, trace_motion, trace_has_residual}),
      .stage_residual(residual),
      .stage_reference(reference),
      .stage_prediction(prediction),
      .stage_sample(sample)
  );
endmodule

bind hmlfc_decode_unit hmlfc_checker_bind #(
    .BLOCK_LOG2(BLOCK_LOG2),
    .MAX_DEPTH(MAX_DEPTH)
) hmlfc_lock_step (
    .request(s_request_tdata[59:0]),
    .*
);
