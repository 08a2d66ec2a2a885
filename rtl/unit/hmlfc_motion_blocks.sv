// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Takes the motion of each block from its motion tile (MOT-3, MOT-4), one block a clock.
//
// Waits at its input until the tile is loaded and gives it back when the palette has been read. Blocks
// without a motion tile pass. Latency 6 clocks.
module hmlfc_motion_blocks #(
    parameter int BLOCK_LOG2 = 2,
    parameter int CONTEXTS = 4,
    parameter int CONTEXT_WORDS = 64,
    parameter int WINDOW_BITS = 256,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS),
    localparam int FLOW_BITS = hmlfc_pkg::FLOW_BITS,
    localparam int MOTION_BITS = hmlfc_pkg::MOTION_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,

    input logic [CONTEXTS-1:0] ready,
    output logic release_valid,
    output logic [CONTEXT_BITS-1:0] release_context,

    input logic head_write,
    input logic [CONTEXT_BITS-1:0] parsed_context,
    input logic [5:0] head_error,
    input logic [2:0] head_block_log2,
    input logic [5:0] head_columns,
    input logic [2:0] head_palette_size,
    input logic [5:0] head_level_code,
    input logic [13:0] head_total,
    input logic [POSITION_BITS-1:0] head_position,
    input logic palette_write,
    input logic [2:0] palette_number,
    input hmlfc_pkg::motion_t palette_entry,

    output logic read_enable,
    output logic [WORD_BITS-1:0] read_word,
    input logic [WINDOW_BITS-1:0] window,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::flow_t in_flow,
    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow
);

  localparam int STAGES = 6;
  localparam int HEAD_BITS = 6 + 3 + 6 + 3 + 6 + 14 + POSITION_BITS;

  logic [HEAD_BITS-1:0] heads[CONTEXTS];
  logic [MOTION_BITS-1:0] palettes[CONTEXTS*8];
  always_ff @(posedge clk) begin
    if (head_write) begin
      heads[parsed_context] <= {
        head_error,
        head_block_log2,
        head_columns,
        head_palette_size,
        head_level_code,
        head_total,
        head_position
      };
    end
    if (palette_write) palettes[{parsed_context, palette_number}] <= palette_entry;
  end

  logic [STAGES:1] valid;
  logic [STAGES*FLOW_BITS-1:0] flows;
  wire advance = !valid[STAGES] || out_ready;
  wire [CONTEXT_BITS-1:0] in_context = in_flow.motion_context[CONTEXT_BITS-1:0];
  assign in_ready = advance && (!in_flow.motion_asked || ready[in_context]);

  // The block's motion block in its tile.
  logic [14:0] place_x, place_y;
  hmlfc_motion_place #(.BLOCK_LOG2(BLOCK_LOG2)) place (
      .stream, .plane(in_flow.job.plane), .bx(in_flow.job.bx), .by(in_flow.job.by), .x(place_x), .y(place_y)
  );
  wire [6:0] tile_mask = ~(7'h7F << stream.motion_tile_log2);
  logic [5:0] error_0, columns_0, code_0;
  logic [2:0] block_log2_0, palette_size_0;
  logic [13:0] total_0;
  logic [POSITION_BITS-1:0] position_0;
  assign {error_0, block_log2_0, columns_0, palette_size_0, code_0, total_0, position_0} = heads[in_context];
  wire [4:0] column_0 = 5'((place_x[6:0] & tile_mask) >> block_log2_0);
  wire [4:0] row_0 = 5'((place_y[6:0] & tile_mask) >> block_log2_0);

  logic [5:0] error_1, code_1;
  logic [9:0] index_1;
  logic [13:0] total_1;
  logic [WORD_BITS+5:0] position_1;
  logic [3*5-1:0] palette_sizes;  // of stages 1 to 5
  logic [3:0] index_5;
  hmlfc_element_reader #(.WORD_BITS(WORD_BITS), .VALUE_BITS(4), .WINDOW_BITS(WINDOW_BITS)) reader (
      .clk, .advance, .position(position_1), .total(total_1), .level_code(code_1), .index(index_1), .value(index_5),
      .read_enable, .read_word, .window
  );

  hmlfc_pkg::flow_t flow_1, next_2, flow_5, next_6;
  hmlfc_pkg::motion_t entry_5;
  assign flow_1 = flows[0+:FLOW_BITS];
  assign flow_5 = flows[4*FLOW_BITS+:FLOW_BITS];
  wire [CONTEXT_BITS-1:0] context_5 = flow_5.motion_context[CONTEXT_BITS-1:0];
  assign entry_5 = palettes[{context_5, index_5[2:0]}];
  always_comb begin
    next_2 = flow_1;
    if (flow_1.motion_asked && flow_1.job.error == 0) next_2.job.error = error_1;
    next_6 = flow_5;
    if (flow_5.motion_asked && flow_5.job.error == 0) begin
      if (index_5 > 4'(palette_sizes[12+:3]) || !entry_5.used) next_6.job.error = HMLFC_ERROR_BAD_MODE;
      next_6.motion = entry_5;
      next_6.motion.used = entry_5.choice != 0;
    end
  end
  assign release_valid = advance && valid[5] && flow_5.motion_asked;
  assign release_context = context_5;

  always_ff @(posedge clk) begin
    if (advance) begin
      valid <= {valid[STAGES-1:1], in_valid && in_ready};
      flows[0+:FLOW_BITS] <= in_flow;
      flows[FLOW_BITS+:FLOW_BITS] <= next_2;
      flows[2*FLOW_BITS+:3*FLOW_BITS] <= flows[FLOW_BITS+:3*FLOW_BITS];
      flows[5*FLOW_BITS+:FLOW_BITS] <= next_6;
      error_1 <= error_0;
      index_1 <= 10'(row_0) * 10'(columns_0) + 10'(column_0);
      position_1 <= {in_context, (WORD_BITS + 6 - CONTEXT_BITS)'(position_0)};
      total_1 <= total_0;
      code_1 <= code_0;
      palette_sizes <= {palette_sizes[11:0], palette_size_0};
    end
    if (!rst_n) valid <= '0;
  end

  assign out_valid = valid[STAGES];
  assign out_flow = flows[5*FLOW_BITS+:FLOW_BITS];

endmodule

`default_nettype wire
