// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Parses the record of a motion tile of a reference image: where its disparities are (MOT-6).
//
// `head_*` are written with `loaded_valid`, 6 clocks after `parse_valid`. In an empty tile the least disparity and the
// level code are 0, and the rest has no meaning.
module hmlfc_disparity_parser #(
    parameter int CONTEXTS = 4,
    parameter int CONTEXT_WORDS = 256,
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
    input logic [15:0] parse_info,  // {height, width} of the tile in samples
    input logic [5:0] parse_error,
    input logic parse_empty,
    input logic [SKEW_BITS-1:0] parse_skew,
    input logic [POSITION_BITS-1:0] parse_bits,

    output logic read_enable,
    output logic [WORD_BITS-1:0] read_word,
    input logic [WINDOW_BITS-1:0] window,

    output logic [5:0] head_error,
    output logic [12:0] head_least,
    output logic [5:0] head_columns,
    output logic [5:0] head_level_code,
    output logic [13:0] head_total,
    output logic [POSITION_BITS-1:0] head_position,

    output logic loaded_valid,
    output logic [CONTEXT_BITS-1:0] loaded_context,
    output logic loaded_keep
);

  localparam int P = POSITION_BITS;

  typedef enum logic [2:0] {
    IDLE,
    HEAD,
    SIZE,
    VALUES,
    FINISH
  } state_t;
  state_t state;

  logic [CONTEXT_BITS-1:0] context_number;
  logic [7:0] height, width;
  logic [SKEW_BITS-1:0] skew;
  logic [P-1:0] bits;
  logic [5:0] error;
  logic fresh;
  wire [17:0] field = 18'(window >> skew[5:0]);

  logic [4:0] code;
  logic [12:0] least;
  wire [7:0] grid_mask = ~(8'hFF << stream.disparity_grid_log2);

  // The length of the values follows the tile's size and the level code in a pipeline: sides in grid blocks, their
  // product, and two clocks of hmlfc_bise_bits. The state waits for it.
  logic [7:0] columns, rows;
  logic [10:0] count;
  logic sized;  // the length is there in the next clock
  always_ff @(posedge clk) begin
    columns <= (width + grid_mask) >> stream.disparity_grid_log2;
    rows <= (height + grid_mask) >> stream.disparity_grid_log2;
    count <= 11'(columns) * 11'(rows);
    sized <= state == SIZE;
  end
  hmlfc_bise_bits size (
      .clk, .count, .level_code({1'b0, code}), .bits(head_total)
  );

  assign parse_ready = state == IDLE;
  assign read_enable = 1'b1;
  wire [WORD_BITS-CONTEXT_BITS-1:0] skew_bits = (WORD_BITS - CONTEXT_BITS)'(skew);
  assign read_word = {context_number, skew_bits >> 6};
  assign head_error = error;
  assign head_least = least;
  assign head_columns = columns[5:0];
  assign head_level_code = {1'b0, code};
  assign head_position = P'(skew) + P'(18);
  assign loaded_valid = state == FINISH;
  assign loaded_context = context_number;
  assign loaded_keep = error != HMLFC_ERROR_BUS_ERROR;

  always_ff @(posedge clk) begin
    fresh <= 1'b1;
    unique case (state)
      IDLE:
      if (parse_valid) begin
        context_number <= parse_context;
        {height, width} <= parse_info;
        skew <= parse_skew;
        bits <= parse_bits;
        error <= parse_error;
        code <= '0;
        least <= '0;
        fresh <= 1'b0;
        state <= parse_error != 0 || parse_empty ? FINISH : HEAD;
      end
      HEAD:
      if (fresh) begin
        {code, least} <= field;
        state <= SIZE;
        if (P'(18) > bits) begin
          error <= HMLFC_ERROR_TILE_OVERRUN;
          state <= FINISH;
        end else if (field[17:13] > 5'(HMLFC_MAX_DISPARITY_CODE)) begin
          error <= HMLFC_ERROR_BAD_LEVELS;
          state <= FINISH;
        end
      end
      SIZE: if (sized) state <= VALUES;
      VALUES: begin
        if (P'(18) + P'(head_total) > bits) error <= HMLFC_ERROR_TILE_OVERRUN;
        state <= FINISH;
      end
      default: state <= IDLE;  // FINISH
    endcase
    if (!rst_n) state <= IDLE;
  end

endmodule

`default_nettype wire
