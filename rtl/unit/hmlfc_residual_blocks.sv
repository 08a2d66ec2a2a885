// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Takes the residual and, in streams without motion tiles, the vector of each block from its tile
// (TIL-5 to TIL-10), one block in CLOCKS clocks.
//
// Waits at its input until the block's tile is loaded, gives the tile back (`release_*`) when its bits
// have been read, and leaves with the block's residuals, 0 in states without. An error of an earlier
// stage stays; else the first of the block's entry is set (MOT-10). Stages of CLOCKS clocks: in each but the last those
// of `scale` go on, which takes the rows of a block one part a clock. 12 stages, with 2 clocks 10, with 4 clocks 9.
module hmlfc_residual_blocks #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int CLOCKS = 1,  // 1, 2, 4
    parameter int PARSERS = 1,  // 1, 2
    parameter int CONTEXTS = 8,
    parameter int CONTEXT_WORDS = 256,
    parameter int WINDOW_BITS = 256,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS),
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int FLOW_BITS = hmlfc_pkg::FLOW_BITS,
    localparam int ENTRY_BITS = 6 + 6 + 4 + 14 + POSITION_BITS,
    localparam int VECTOR_BITS = 18,
    localparam int PARSER_LOG2 = PARSERS - 1,
    localparam int PARSED_BITS = CONTEXT_BITS - PARSER_LOG2
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,

    input logic [CONTEXTS-1:0] ready,
    output logic release_valid,
    output logic [CONTEXT_BITS-1:0] release_context,

    input logic [PARSERS-1:0] head_write,
    input logic [PARSERS-1:0] vector_write,
    input logic [PARSERS-1:0] entry_write,
    input logic [PARSERS*PARSED_BITS-1:0] parsed_context,
    input logic [PARSERS*6-1:0] head_error,
    input logic [PARSERS*64-1:0] head_motion,
    input logic [PARSERS*64-1:0] head_residual,
    input logic [PARSERS*6-1:0] vector_number,
    input logic [PARSERS*VECTOR_BITS-1:0] vector_data,
    input logic [PARSERS*6-1:0] entry_number,
    input logic [PARSERS*ENTRY_BITS-1:0] entry_data,

    output logic read_enable,
    output logic [WORD_BITS-1:0] read_word,
    input logic [WINDOW_BITS-1:0] window,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::flow_t in_flow,

    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow,
    output logic out_has_residual,
    output logic [SAMPLES*VALUE_BITS-1:0] out_residual
);

  localparam int STAGES = 8 + 4 / CLOCKS;
  localparam int CLOCK_BITS = $clog2(CLOCKS) > 0 ? $clog2(CLOCKS) : 1;
  localparam int BITS = SAMPLES * VALUE_BITS;  // of a block's values, at most
  localparam int PART_BITS = BITS / CLOCKS;

  // The 1 bits of `mask`, whose bits are of the blocks from `first` on, before block `number`.
  localparam int MASK_BITS = 64 / CLOCKS;
  function automatic logic [5:0] rank(
      input logic [MASK_BITS-1:0] mask, input logic [5:0] first, input logic [5:0] number);
    rank = '0;
    for (int i = 0; i < MASK_BITS; i++) rank = rank + 6'(mask[i] && (first | 6'(i)) < number);
  endfunction

  // The flow of blocks: stage i holds what it knows after i clocks.
  logic [STAGES:1] valid;
  logic [STAGES*FLOW_BITS-1:0] flows;
  logic [STAGES:2] has_residual;
  logic [CLOCK_BITS-1:0] part;
  wire last = CLOCKS == 1 || part == CLOCK_BITS'(CLOCKS - 1);
  wire advance = last && (!valid[STAGES] || out_ready);
  wire step = !last || advance;  // of a part
  wire [CONTEXT_BITS-1:0] in_context = in_flow.residual_context[CONTEXT_BITS-1:0];
  assign in_ready = advance && (!in_flow.residual_asked || ready[in_context]);

  // Stage 1: the head of the tile.
  hmlfc_pkg::flow_t flow_1;
  logic [5:0] number_1, head_error_1;
  logic [63:0] motion_mask_1, residual_mask_1;
  assign flow_1 = flows[0+:FLOW_BITS];
  wire [2:0] i = in_flow.job.bx[2:0];
  wire [2:0] j = in_flow.job.by[2:0];
  localparam int HEAD_BITS = 6 + 128;
  localparam int PARSED = CONTEXTS / PARSERS;
  logic [PARSERS*HEAD_BITS-1:0] heads;
  wire odd_1 = PARSERS == 2 && flow_1.residual_context[0];
  assign {head_error_1, motion_mask_1, residual_mask_1} =
      odd_1 ? heads[PARSERS*HEAD_BITS-1-:HEAD_BITS] : heads[HEAD_BITS-1:0];

  // Stage 2: masks to ranks, one part a clock; stage 3: entry and vector.
  wire [5:0] first = CLOCKS == 1 ? 6'd0 : 6'(part) << $clog2(MASK_BITS);
  logic [5:0] motion_before, residual_before;
  wire [5:0] motion_rank = (first == 0 ? 6'd0 : motion_before) +
      rank(MASK_BITS'(motion_mask_1 >> first), first, number_1);
  wire [5:0] residual_rank = (first == 0 ? 6'd0 : residual_before) +
      rank(MASK_BITS'(residual_mask_1 >> first), first, number_1);
  hmlfc_pkg::flow_t flow_2, flow_3, next_2, next_4;
  logic has_motion_2;
  logic [5:0] vector_2, entry_2;
  logic [VECTOR_BITS-1:0] vector_3;
  logic [ENTRY_BITS-1:0] entry_3;
  logic has_motion_3;
  assign flow_2 = flows[FLOW_BITS+:FLOW_BITS];
  assign flow_3 = flows[2*FLOW_BITS+:FLOW_BITS];
  wire [PARSED_BITS-1:0] parsed_2 = flow_2.residual_context[CONTEXT_BITS-1:PARSER_LOG2];
  wire [CONTEXT_BITS-1:0] context_3 = flow_3.residual_context[CONTEXT_BITS-1:0];
  logic [PARSERS*VECTOR_BITS-1:0] vectors;
  logic [PARSERS*ENTRY_BITS-1:0] entries;
  wire odd_3 = PARSERS == 2 && context_3[0];
  assign vector_3 = odd_3 ? vectors[PARSERS*VECTOR_BITS-1-:VECTOR_BITS] : vectors[VECTOR_BITS-1:0];
  assign entry_3 = odd_3 ? entries[PARSERS*ENTRY_BITS-1-:ENTRY_BITS] : entries[ENTRY_BITS-1:0];
  for (genvar p = 0; p < PARSERS; p++) begin : g_parsed
    wire [PARSED_BITS-1:0] written = parsed_context[p*PARSED_BITS+:PARSED_BITS];
    hmlfc_ram #(.WIDTH(HEAD_BITS), .DEPTH(PARSED)) head_memory (
        .clk, .write(head_write[p]), .write_address(written),
        .write_data({head_error[p*6+:6], head_motion[p*64+:64], head_residual[p*64+:64]}), .read(advance),
        .read_address(in_context[CONTEXT_BITS-1:PARSER_LOG2]), .read_data(heads[p*HEAD_BITS+:HEAD_BITS])
    );
    hmlfc_ram #(.WIDTH(VECTOR_BITS), .DEPTH(PARSED * 64)) vector_memory (
        .clk, .write(vector_write[p]), .write_address({written, vector_number[p*6+:6]}),
        .write_data(vector_data[p*VECTOR_BITS+:VECTOR_BITS]), .read(advance),
        .read_address({parsed_2, vector_2}),
        .read_data(vectors[p*VECTOR_BITS+:VECTOR_BITS])
    );
    hmlfc_ram #(.WIDTH(ENTRY_BITS), .DEPTH(PARSED * 64)) entry_memory (
        .clk, .write(entry_write[p]), .write_address({written, entry_number[p*6+:6]}),
        .write_data(entry_data[p*ENTRY_BITS+:ENTRY_BITS]), .read(advance),
        .read_address({parsed_2, entry_2}), .read_data(entries[p*ENTRY_BITS+:ENTRY_BITS])
    );
  end

  always_comb begin
    next_2 = flow_1;
    if (flow_1.residual_asked && flow_1.job.error == 0) next_2.job.error = head_error_1;
  end

  // Stage 4: the record memory is read, the first part of the block's bits with `advance`.
  wire [5:0] entry_error = entry_3[ENTRY_BITS-1-:6];
  wire [5:0] entry_code = entry_3[ENTRY_BITS-7-:6];
  wire [3:0] entry_step = entry_3[ENTRY_BITS-13-:4];
  wire [13:0] entry_bias = entry_3[POSITION_BITS+:14];
  wire [POSITION_BITS-1:0] entry_position = entry_3[POSITION_BITS-1:0];
  always_comb begin
    next_4 = flow_3;
    if (has_motion_3) begin
      next_4.motion.used = 1'b1;
      next_4.motion.negative = vector_3[16];
      next_4.motion.choice = 4'd11;
      next_4.motion.explicit_x = 12'($signed(vector_3[7:0]));
      next_4.motion.explicit_y = 12'($signed(vector_3[15:8]));
    end
    if (flow_3.job.error == 0) begin
      if (has_motion_3 && vector_3[17]) next_4.job.error = HMLFC_ERROR_VECTOR_RANGE;
      else if (has_residual[3]) next_4.job.error = entry_error;
    end
  end
  logic [POSITION_BITS-1:0] next_position;
  wire [POSITION_BITS-1:0] read_position = last ? entry_position : next_position;
  logic [CONTEXT_BITS-1:0] context_4;
  wire [CONTEXT_BITS-1:0] read_context = last ? context_3 : context_4;
  assign read_enable = step;
  assign read_word = {read_context, (WORD_BITS - CONTEXT_BITS)'(read_position >> 6)};
  // The tile is given back with the last read.
  logic asked_4;
  assign release_valid = advance && (CLOCKS == 1 ? valid[3] && flow_3.residual_asked : valid[4] && asked_4);
  assign release_context = CLOCKS == 1 ? context_3 : context_4;

  // From stage 4 on: bits, values, residuals.
  logic [5:0] shift_4, code_4, code_5, code_6, code_7, code_8;
  logic [3:0] step_4, step_5, step_6, step_7, step_8;
  logic [13:0] bias_4, bias_5, bias_6, bias_7, bias_8;
  wire [PART_BITS-1:0] bits_part = PART_BITS'(window >> shift_4);
  logic [BITS-1:0] bits_4, bits_5;
  logic [BITS-1:0] values_8, gathered;
  logic [PART_BITS-1:0] value_part, residual_part;
  hmlfc_pkg::flow_t flow_8;
  assign flow_8 = flows[7*FLOW_BITS+:FLOW_BITS];
  hmlfc_bise_unpack #(.COUNT(SAMPLES), .VALUE_BITS(VALUE_BITS), .WINDOW_BITS(BITS)) unpack (
      .clk, .advance, .level_code(code_5), .window(bits_5), .values(values_8)
  );
  always_comb begin
    value_part = '0;
    for (int p = 0; p < CLOCKS; p++) begin
      if (CLOCKS == 1 || part == CLOCK_BITS'(p)) value_part = values_8[p*PART_BITS+:PART_BITS];
    end
  end
  hmlfc_residual #(.BLOCK_LOG2(BLOCK_LOG2), .ROWS((1 << BLOCK_LOG2) / CLOCKS), .MAX_DEPTH(MAX_DEPTH)) scale (
      .clk, .advance(step), .values(value_part), .level_code(code_8), .bias(bias_8[VALUE_BITS-1:0]), .step_code(step_8),
      .chroma(flow_8.job.plane != 2'd0), .depth(stream.depth), .residuals(residual_part)
  );

  always_ff @(posedge clk) begin
    if (advance) begin
      valid <= {valid[STAGES-1:1], in_valid && in_ready};
      flows[0+:FLOW_BITS] <= in_flow;
      flows[FLOW_BITS+:FLOW_BITS] <= next_2;
      flows[2*FLOW_BITS+:FLOW_BITS] <= flow_2;
      flows[3*FLOW_BITS+:FLOW_BITS] <= next_4;
      flows[4*FLOW_BITS+:(STAGES-4)*FLOW_BITS] <= flows[3*FLOW_BITS+:(STAGES-4)*FLOW_BITS];

      number_1 <= {j[2:1], i[2:1], j[0], i[0]};

      has_motion_2 <= flow_1.residual_asked && motion_mask_1[number_1] && head_error_1 == 0;
      vector_2 <= motion_rank;
      entry_2 <= residual_rank;

      has_motion_3 <= has_motion_2;

      {code_4, step_4, bias_4} <= {entry_code, entry_step, entry_bias};
      {code_5, step_5, bias_5} <= {code_4, step_4, bias_4};
      asked_4 <= flow_3.residual_asked;
      bits_5 <= bits_4;
      {code_6, step_6, bias_6} <= {code_5, step_5, bias_5};
      {code_7, step_7, bias_7} <= {code_6, step_6, bias_6};
      {code_8, step_8, bias_8} <= {code_7, step_7, bias_7};

      has_residual <= {
        has_residual[STAGES-1:2], flow_1.residual_asked && residual_mask_1[number_1] && head_error_1 == 0
      };
    end
    if (step) begin
      {motion_before, residual_before} <= {motion_rank, residual_rank};
      shift_4 <= read_position[5:0];
      next_position <= read_position + POSITION_BITS'(PART_BITS);
      context_4 <= read_context;
    end
    if (!rst_n || advance) part <= '0;
    else if (!last) part <= part + 1'b1;
    if (!rst_n) valid <= '0;
  end

  if (CLOCKS == 1) begin : g_block
    assign bits_4 = bits_part;
    assign gathered = residual_part;
  end else begin : g_parts
    logic [(CLOCKS-1)*PART_BITS-1:0] earlier_bits, earlier;
    assign bits_4 = {bits_part, earlier_bits};
    assign gathered = {residual_part, earlier};
    always_ff @(posedge clk) begin
      if (step) begin
        earlier_bits <= bits_4[BITS-1:PART_BITS];
        earlier <= gathered[BITS-1:PART_BITS];
      end
    end
  end

  assign out_valid = valid[STAGES] && last;
  assign out_flow = flows[(STAGES-1)*FLOW_BITS+:FLOW_BITS];
  assign out_has_residual = has_residual[STAGES];
  assign out_residual = gathered & {SAMPLES * VALUE_BITS{has_residual[STAGES]}};

endmodule

`default_nettype wire
