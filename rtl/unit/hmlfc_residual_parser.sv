// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Parses the head of a residual tile's record (TIL-1 to TIL-8, STP-1) and lists its blocks.
//
// From a record that the loader brought, in its context's part of the record memory, it makes
//   head      masks of the blocks with motion and with a residual, or an error of the whole tile;
//   vectors   for the m-th block with motion: sign and vector (TIL-7), or vector_range;
//   entries   for the m-th block with a residual: its header and where its values begin, or an error.
// `loaded_valid` is high when all are written, until `loaded_ready`. Two clocks a field, three for a mask that the record holds, then one for
// each vector, or two with one reader, and each entry.
module hmlfc_residual_parser #(
    parameter int BLOCK_LOG2 = 2,
    parameter int CONTEXTS = 8,
    parameter int CONTEXT_WORDS = 256,  // words of 64 bits of a context's part of the memory
    parameter int WINDOW_BITS = 256,
    parameter int SKEW_BITS = 7,
    parameter int READERS = 2,  // of vectors: 1, 2
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS),
    localparam int VECTOR_BITS = 18,
    localparam int ENTRY_BITS = 6 + 6 + 4 + 14 + POSITION_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,

    input logic parse_valid,
    output logic parse_ready,
    input logic [CONTEXT_BITS-1:0] parse_context,
    input logic [8:0] parse_info,  // {predictive, rows, columns} of the blocks in the plane
    input logic [5:0] parse_error,
    input logic parse_empty,
    input logic [SKEW_BITS-1:0] parse_skew,
    input logic [POSITION_BITS-1:0] parse_bits,

    // Read ports of the record memory; a second is for vertical components only.
    output logic [READERS-1:0] read_enable,
    output logic [READERS*WORD_BITS-1:0] read_word,
    input logic [READERS*WINDOW_BITS-1:0] window,

    output logic head_write,
    output logic [5:0] head_error,
    output logic [63:0] head_motion,
    output logic [63:0] head_residual,

    output logic vector_write,
    output logic [5:0] vector_number,
    output logic [VECTOR_BITS-1:0] vector_data,  // {vector_range, sign, dy, dx}

    output logic entry_write,
    output logic [5:0] entry_number,
    output logic [ENTRY_BITS-1:0] entry_data,  // {error, level code, step code, bias, position of the values}

    output logic loaded_valid,
    input logic loaded_ready,
    output logic [CONTEXT_BITS-1:0] loaded_context,
    output logic loaded_keep
);

  localparam int P = POSITION_BITS;
  localparam int PLACE_BITS = WORD_BITS + 6 - CONTEXT_BITS;  // of bit positions in a context's part of the memory

  typedef enum logic [3:0] {
    IDLE,
    MODES,
    MOTION_MASK,
    RESIDUAL_MASK,
    CHECK,
    BOUNDS,
    SIGNS,
    PLACES,
    VECTORS,
    RESIDUALS,
    HEADERS,
    DRAIN,
    FINISH
  } state_t;
  state_t state;

  // The record, and the position in it that is read.
  logic [CONTEXT_BITS-1:0] context_number;
  logic predictive;
  logic [3:0] rows, columns;
  logic [SKEW_BITS-1:0] skew;
  logic [P-1:0] bits, position;
  logic [5:0] error;

  // The 64 bits at `position` are in `field` when `fresh` (CNV-4).
  logic fresh;
  logic [5:0] shift;
  wire [P-1:0] address = position + P'(skew);
  wire [79:0] field = 80'(window[WINDOW_BITS-1:0] >> shift);

  logic [1:0] motion_mode, residual_mode;
  logic held;  // the field of a mask, or with one reader of bounds or what headers share, is in `held_field`
  logic [79:0] held_field;
  logic [63:0] in_plane, mask, motion_mask, residual_mask;
  logic [6:0] mask_bits;
  wire [1:0] mask_mode = state == MOTION_MASK ? motion_mode : residual_mode;
  hmlfc_tile_mask masks (
      .columns, .rows, .mode(mask_mode), .field(held_field), .in_plane, .mask, .bits(mask_bits)
  );
  logic [6:0] motion_count, residual_count;
  wire [6:0] ones = 7'($countones(state == CHECK ? residual_mask : motion_mask));

  logic [5:0] bounds_error, next_codes_x, next_codes_y, codes_x, codes_y;
  logic [1:0] next_sign_mode, sign_mode;
  logic signed [8:0] next_min_x, next_min_y, min_x, min_y;
  logic [P-1:0] bounds_end;
  hmlfc_vector_bounds bounds (
      .clk, .rst_n, .search_window(stream.window), .field(READERS == 2 ? field[28:0] : held_field[28:0]), .position, .bits,
      .error(bounds_error),
      .sign_mode(next_sign_mode), .min_x(next_min_x), .min_y(next_min_y), .codes_x(next_codes_x),
      .codes_y(next_codes_y), .next(bounds_end)
  );

  logic [63:0] signs;
  logic [P-1:0] vectors_end;
  logic vectors_start, vectors_placed;
  wire vectors_active = state == VECTORS;
  logic vectors_last;
  logic [READERS-1:0] vectors_enable;
  logic [READERS*WORD_BITS-1:0] vectors_word;
  hmlfc_tile_vectors #(
      .WORD_BITS(WORD_BITS), .PLACE_BITS(PLACE_BITS), .WINDOW_BITS(WINDOW_BITS), .READERS(READERS)
  ) vectors (
      .clk, .rst_n, .count(motion_count), .min_x, .min_y, .codes_x, .codes_y, .signs, .search_window(stream.window),
      .position, .start(vectors_start), .placed(vectors_placed), .next(vectors_end), .context_number,
      .skew(PLACE_BITS'(skew)), .active(vectors_active), .last(vectors_last), .read_enable(vectors_enable),
      .read_word(vectors_word), .window, .vector_write, .vector_number, .vector_data
  );

  logic [5:0] shared_error;
  logic [4:0] shared_bits, header_bits;
  logic headers_overrun, headers_last, headers_pending;
  wire headers_start = state == RESIDUALS && (READERS == 2 ? fresh : held);
  wire headers_active = state == HEADERS;
  hmlfc_tile_headers #(.BLOCK_LOG2(BLOCK_LOG2), .SKEW_BITS(SKEW_BITS), .LATE(2 - READERS)) headers (
      .clk, .rst_n, .count(residual_count), .depth(stream.depth), .steps(stream.features.residual_step), .skew, .bits,
      .field(READERS == 2 ? field[31:0] : held_field[31:0]), .position, .start(headers_start), .shared_error,
      .shared_bits, .active(headers_active), .header_bits, .overrun(headers_overrun), .last(headers_last),
      .pending(headers_pending), .entry_write, .entry_number, .entry_data
  );

  assign parse_ready = state == IDLE;
  // Yosys 0.23 gives an operator in a concatenation the width that a cast operand had before the cast: no casts there.
  wire [WORD_BITS-1:0] field_word = {context_number, (WORD_BITS - CONTEXT_BITS)'(address >> 6)};
  always_comb begin
    read_enable = vectors_enable;
    read_word = vectors_word;
    if (state != VECTORS) begin
      read_enable[0] = 1'b1;
      read_word[WORD_BITS-1:0] = field_word;
    end
  end
  assign head_write = state == FINISH;
  assign head_error = error;
  assign head_motion = motion_mask;
  assign head_residual = residual_mask;
  assign loaded_valid = state == FINISH;
  assign loaded_context = context_number;
  assign loaded_keep = error != HMLFC_ERROR_BUS_ERROR;

  always_ff @(posedge clk) begin
    shift <= address[5:0];
    fresh <= 1'b1;
    held_field <= field;
    vectors_start <= state == SIGNS && fresh && error == 0;
    unique case (state)
      IDLE:
      if (parse_valid) begin
        context_number <= parse_context;
        {predictive, rows, columns} <= parse_info;
        skew <= parse_skew;
        bits <= parse_bits;
        error <= parse_error;
        motion_mask <= '0;
        residual_mask <= '0;
        position <= '0;
        fresh <= 1'b0;
        held <= 1'b0;
        state <= parse_empty || parse_error != 0 ? FINISH : MODES;
      end
      MODES:
      if (fresh) begin
        motion_mode <= predictive ? field[1:0] : 2'd0;
        residual_mode <= predictive ? field[3:2] : field[1:0];
        position <= position + (predictive ? P'(4) : P'(2));
        fresh <= 1'b0;
        state <= MOTION_MASK;
      end
      MOTION_MASK, RESIDUAL_MASK:
      if (mask_mode[1] && !held) held <= fresh;  // the other modes have no field
      else begin
        held <= 1'b0;
        if (state == MOTION_MASK) motion_mask <= mask;
        else residual_mask <= mask;
        motion_count <= ones;
        position <= position + P'(mask_bits);
        fresh <= !mask_mode[1];
        state <= state == MOTION_MASK ? RESIDUAL_MASK : CHECK;
      end
      CHECK: begin
        residual_count <= ones;
        if (position > bits) error <= HMLFC_ERROR_TILE_OVERRUN;
        else if (((motion_mask | residual_mask) & ~in_plane) != 0) error <= HMLFC_ERROR_MASK_OUTSIDE;
        if (position > bits || ((motion_mask | residual_mask) & ~in_plane) != 0) state <= FINISH;
        else if (motion_mask != 0) state <= BOUNDS;
        else state <= residual_mask != 0 ? RESIDUALS : FINISH;
      end
      BOUNDS:
      if (READERS == 2 ? !fresh : !held) held <= fresh;
      else begin
        held <= 1'b0;
        sign_mode <= next_sign_mode;
        min_x <= next_min_x;
        min_y <= next_min_y;
        codes_x <= next_codes_x;
        codes_y <= next_codes_y;
        position <= bounds_end;
        fresh <= 1'b0;
        error <= bounds_error;
        state <= SIGNS;
      end
      SIGNS:
      if (error != 0) state <= FINISH;
      else if (fresh) begin
        signs <= sign_mode == 2'd2 ? field[63:0] : {64{sign_mode[0]}};
        if (sign_mode == 2'd2) position <= position + P'(motion_count);
        state <= PLACES;
      end
      PLACES:
      if (vectors_placed) begin
        position <= vectors_end;
        state <= VECTORS;
      end
      VECTORS:
      if (vectors_last) begin
        fresh <= 1'b0;
        if (position > bits) error <= HMLFC_ERROR_TILE_OVERRUN;
        state <= position <= bits && residual_mask != 0 ? RESIDUALS : FINISH;
      end
      RESIDUALS:
      if (READERS == 2 ? !fresh : !held) held <= fresh;
      else begin
        held <= 1'b0;
        position <= position + P'(shared_bits);
        fresh <= 1'b0;
        error <= shared_error;
        state <= shared_error != 0 ? FINISH : HEADERS;
      end
      HEADERS: begin
        position <= position + P'(header_bits);
        if (headers_overrun) error <= HMLFC_ERROR_TILE_OVERRUN;
        if (headers_overrun) state <= FINISH;
        else if (headers_last) state <= DRAIN;
      end
      DRAIN: if (!headers_pending) state <= FINISH;
      default: if (loaded_ready) state <= IDLE;  // FINISH
    endcase
    if (!rst_n) state <= IDLE;
  end

endmodule

`default_nettype wire
