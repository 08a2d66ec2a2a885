// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Takes the disparity of each block that shares one from the tile that holds its grid block (MOT-6),
// one block a clock.
//
// `in_x` and `in_y` are the grid block's column and row in the tile. Waits at its input until the tile is
// loaded and gives it back when its bits have been read. Blocks that share none pass. Latency 6 clocks.
module hmlfc_disparity_blocks #(
    parameter int CONTEXTS = 4,
    parameter int CONTEXT_WORDS = 256,
    parameter int WINDOW_BITS = 256,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS),
    localparam int FLOW_BITS = hmlfc_pkg::FLOW_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic [CONTEXTS-1:0] ready,
    output logic release_valid,
    output logic [CONTEXT_BITS-1:0] release_context,

    input logic head_write,
    input logic [CONTEXT_BITS-1:0] parsed_context,
    input logic [5:0] head_error,
    input logic [12:0] head_least,
    input logic [5:0] head_columns,
    input logic [5:0] head_level_code,
    input logic [13:0] head_total,
    input logic [POSITION_BITS-1:0] head_position,

    output logic read_enable,
    output logic [WORD_BITS-1:0] read_word,
    input logic [WINDOW_BITS-1:0] window,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::flow_t in_flow,
    input logic [4:0] in_x,
    input logic [4:0] in_y,
    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow
);

  localparam int STAGES = 6;
  localparam int HEAD_BITS = 6 + 13 + 6 + 6 + 14 + POSITION_BITS;
  localparam signed [13:0] MAX_DISPARITY = 14'sd4095;

  logic [HEAD_BITS-1:0] heads[CONTEXTS];
  always_ff @(posedge clk) begin
    if (head_write) begin
      heads[parsed_context] <= {
        head_error, head_least, head_columns, head_level_code, head_total, head_position
      };
    end
  end

  logic [STAGES:1] valid;
  logic [STAGES*FLOW_BITS-1:0] flows;
  wire advance = !valid[STAGES] || out_ready;
  wire [CONTEXT_BITS-1:0] in_context = in_flow.disparity_context[CONTEXT_BITS-1:0];
  assign in_ready = advance && (!in_flow.disparity_asked || ready[in_context]);

  logic [5:0] error_0, columns_0, code_0;
  logic [12:0] least_0;
  logic [13:0] total_0;
  logic [POSITION_BITS-1:0] position_0;
  assign {error_0, least_0, columns_0, code_0, total_0, position_0} = heads[in_context];

  logic [5:0] error_1, code_1;
  logic [9:0] index_1, value_5;
  logic [13:0] total_1;
  logic [WORD_BITS+5:0] position_1;
  logic [5*13-1:0] leasts;  // of stages 1 to 5
  hmlfc_element_reader #(.WORD_BITS(WORD_BITS), .VALUE_BITS(10), .WINDOW_BITS(WINDOW_BITS)) reader (
      .clk, .advance, .position(position_1), .total(total_1), .level_code(code_1), .index(index_1), .value(value_5),
      .read_enable, .read_word, .window
  );

  hmlfc_pkg::flow_t flow_1, flow_3, next_2, flow_5, next_6;
  assign flow_1 = flows[0+:FLOW_BITS];
  assign flow_3 = flows[2*FLOW_BITS+:FLOW_BITS];
  assign flow_5 = flows[4*FLOW_BITS+:FLOW_BITS];
  wire signed [13:0] disparity = $signed(leasts[4*13+:13]) + $signed({4'b0000, value_5});
  always_comb begin
    next_2 = flow_1;
    if (flow_1.disparity_asked && flow_1.job.error == 0) next_2.job.error = error_1;
    next_6 = flow_5;
    if (flow_5.disparity_asked && flow_5.job.error == 0) begin
      if (disparity > MAX_DISPARITY) next_6.job.error = HMLFC_ERROR_VECTOR_RANGE;
      next_6.disparity = disparity[12:0];
    end
  end
  // The reader's window is taken over at the end of stage 3.
  assign release_valid = advance && valid[3] && flow_3.disparity_asked;
  assign release_context = flow_3.disparity_context[CONTEXT_BITS-1:0];

  always_ff @(posedge clk) begin
    if (advance) begin
      valid <= {valid[STAGES-1:1], in_valid && in_ready};
      flows[0+:FLOW_BITS] <= in_flow;
      flows[FLOW_BITS+:FLOW_BITS] <= next_2;
      flows[2*FLOW_BITS+:3*FLOW_BITS] <= flows[FLOW_BITS+:3*FLOW_BITS];
      flows[5*FLOW_BITS+:FLOW_BITS] <= next_6;
      error_1 <= error_0;
      index_1 <= 10'(in_y) * 10'(columns_0) + 10'(in_x);
      position_1 <= {in_context, (WORD_BITS + 6 - CONTEXT_BITS)'(position_0)};
      total_1 <= total_0;
      code_1 <= code_0;
      leasts <= {leasts[4*13-1:0], least_0};
    end
    if (!rst_n) valid <= '0;
  end

  assign out_valid = valid[STAGES];
  assign out_flow = flows[5*FLOW_BITS+:FLOW_BITS];

endmodule

`default_nettype wire
