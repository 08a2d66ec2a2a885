// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Parses the record of a motion tile of a predictive image: head, palette, place of the indices (MOT-3).
//
// `head_*` and `palette_*` are written before `loaded_valid`. An empty tile gets the entry of MOT-4.
// Two clocks for the head and for each palette entry; the length of the indices is worked out meanwhile.
module hmlfc_motion_parser #(
    parameter int BLOCK_LOG2 = 2,
    parameter int CONTEXTS = 4,
    parameter int CONTEXT_WORDS = 64,
    parameter int WINDOW_BITS = 256,
    parameter int SKEW_BITS = 7,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS)
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,

    input logic parse_valid,
    output logic parse_ready,
    input logic [CONTEXT_BITS-1:0] parse_context,
    input logic [16:0] parse_info,  // {keyed, height, width} of the tile in samples
    input logic [5:0] parse_error,
    input logic parse_empty,
    input logic [SKEW_BITS-1:0] parse_skew,
    input logic [POSITION_BITS-1:0] parse_bits,

    output logic read_enable,
    output logic [WORD_BITS-1:0] read_word,
    input logic [WINDOW_BITS-1:0] window,

    output logic head_write,
    output logic [5:0] head_error,
    output logic [2:0] head_block_log2,
    output logic [5:0] head_columns,
    output logic [2:0] head_palette_size,  // number of the last entry
    output logic [5:0] head_level_code,
    output logic [13:0] head_total,
    output logic [POSITION_BITS-1:0] head_position,

    output logic palette_write,
    output logic [2:0] palette_number,
    output hmlfc_pkg::motion_t palette_entry,  // `used` stands for an entry that may be used

    output logic loaded_valid,
    output logic [CONTEXT_BITS-1:0] loaded_context,
    output logic loaded_keep
);

  localparam int P = POSITION_BITS;

  typedef enum logic [2:0] {
    IDLE,
    EMPTY,
    HEAD,
    ENTRY,
    INDICES,
    FINISH
  } state_t;
  state_t state;

  logic [CONTEXT_BITS-1:0] context_number;
  logic keyed;
  logic [7:0] height, width;
  logic [SKEW_BITS-1:0] skew;
  logic [P-1:0] bits, position;
  logic [5:0] error;

  logic fresh;
  logic [5:0] shift;
  wire [P-1:0] address = position + P'(skew);
  wire [31:0] field = 32'(window >> shift);

  logic [1:0] motion_block;
  logic [2:0] palette_size, number;
  logic [3:0] explicit_bits;

  // The least level code whose level count is at least palette_size + 1.
  logic [5:0] level_code;
  always_comb level_code = palette_size == 3'd7 ? 6'd6 : 6'(palette_size);

  wire [2:0] block_log2 = 3'(motion_block) + 3'd2;
  wire [7:0] block_mask = ~(8'hFF << block_log2);

  // The length of the indices follows the head in a pipeline of 4 clocks: sides in motion blocks, their product, and
  // two clocks of hmlfc_bise_bits.
  logic [7:0] columns, rows;
  logic [10:0] count;
  logic [13:0] total;
  logic [3:0] sizing;  // clocks until it is there, one bit each
  always_ff @(posedge clk) begin
    columns <= (width + block_mask) >> block_log2;
    rows <= (height + block_mask) >> block_log2;
    count <= 11'(columns) * 11'(rows);
    sizing <= state == HEAD ? 4'b1111 : sizing >> 1;
  end
  hmlfc_bise_bits size (
      .clk, .count, .level_code, .bits(total)
  );

  // Fields of a palette entry, each one shift after the previous one; explicit_x and explicit_y are signed (CNV-5).
  wire two = stream.features.two_references;
  wire shared = stream.features.shared_disparity;
  wire [28:0] from_choice = two ? field[31:3] : field[28:0];
  wire [24:0] from_sign = from_choice[28:4];
  wire [3:0] choice = from_choice[3:0];
  wire [23:0] from_x = keyed ? from_sign[23:0] : from_sign[24:1];
  wire has_x = choice == 4'd10 || choice == 4'd11;
  wire has_y = choice == 4'd11;
  wire [23:0] from_y = from_x >> explicit_bits;
  wire [11:0] explicit_mask = ~(12'hFFF << explicit_bits);
  wire [11:0] x_field = from_x[11:0] & explicit_mask;
  wire [11:0] y_field = from_y[11:0] & explicit_mask;
  wire [3:0] sign_bit = explicit_bits - 4'd1;
  wire x_negative = explicit_bits != 0 && x_field[sign_bit];
  wire y_negative = explicit_bits != 0 && y_field[sign_bit];
  wire [P-1:0] entry_bits = (two ? P'(3) : P'(0)) + (keyed ? P'(4) : P'(5)) +
      (has_x ? P'(explicit_bits) : P'(0)) + (has_y ? P'(explicit_bits) : P'(0));

  always_comb begin
    palette_entry = '0;
    if (state == EMPTY) begin
      palette_entry.used = 1'b1;
      palette_entry.reference_set = two ? 3'd1 : 3'd0;
      palette_entry.choice = !keyed ? 4'd0 : shared ? 4'd1 : 4'd11;
    end else begin
      palette_entry.used = choice <= 4'd11 && (shared || choice == 4'd0 || choice == 4'd11);
      palette_entry.reference_set = two ? field[2:0] : 3'd0;
      palette_entry.choice = choice;
      palette_entry.negative = !keyed && from_sign[0];
      if (has_x) palette_entry.explicit_x = x_negative ? x_field | ~explicit_mask : x_field;
      if (has_y) palette_entry.explicit_y = y_negative ? y_field | ~explicit_mask : y_field;
    end
  end
  assign palette_write = state == EMPTY || (state == ENTRY && fresh);
  assign palette_number = number;

  assign parse_ready = state == IDLE;
  assign read_enable = 1'b1;
  assign read_word = {context_number, (WORD_BITS - CONTEXT_BITS)'(address >> 6)};
  assign head_write = state == FINISH;
  assign head_error = error;
  assign head_block_log2 = block_log2;
  assign head_columns = columns[5:0];
  assign head_palette_size = palette_size;
  assign head_level_code = level_code;
  assign head_total = total;
  assign head_position = address;
  assign loaded_valid = state == FINISH;
  assign loaded_context = context_number;
  assign loaded_keep = error != HMLFC_ERROR_BUS_ERROR;

  always_ff @(posedge clk) begin
    shift <= address[5:0];
    fresh <= 1'b1;
    unique case (state)
      IDLE:
      if (parse_valid) begin
        context_number <= parse_context;
        {keyed, height, width} <= parse_info;
        skew <= parse_skew;
        bits <= parse_bits;
        error <= parse_error;
        position <= '0;
        number <= '0;
        motion_block <= '0;
        palette_size <= '0;
        fresh <= 1'b0;
        state <= parse_error != 0 ? FINISH : parse_empty ? EMPTY : HEAD;
      end
      EMPTY: state <= FINISH;
      HEAD:
      if (fresh) begin
        {explicit_bits, palette_size, motion_block} <= field[8:0];
        position <= position + P'(9);
        fresh <= 1'b0;
        state <= ENTRY;
        if (position + P'(9) > bits) begin
          error <= HMLFC_ERROR_TILE_OVERRUN;
          state <= FINISH;
        end else if (field[8:5] > 4'(HMLFC_MAX_EXPLICIT_BITS) || 32'(field[1:0]) + 2 < BLOCK_LOG2) begin
          error <= HMLFC_ERROR_BAD_MODE;
          state <= FINISH;
        end
      end
      ENTRY:
      if (fresh) begin
        position <= position + entry_bits;
        fresh <= 1'b0;
        number <= number + 3'd1;
        if (number == palette_size) state <= INDICES;
      end
      INDICES:
      if (sizing == 0) begin
        if (position + P'(total) > bits) error <= HMLFC_ERROR_TILE_OVERRUN;
        state <= FINISH;
      end
      default: state <= IDLE;  // FINISH
    endcase
    if (!rst_n) state <= IDLE;
  end

endmodule

`default_nettype wire
