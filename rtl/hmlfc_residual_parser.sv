`include "hmlfc_tables.svh"

// Parses the head of a residual tile's record (TIL-1 to TIL-8, STP-1) and lists its blocks.
//
// From a record that the loader brought, in its context's part of the record memory, it makes
//   head      masks of the blocks with motion and with a residual, or an error of the whole tile;
//   vectors   for the m-th block with motion: sign and vector (TIL-7), or vector_range;
//   entries   for the m-th block with a residual: its header and where its values begin, or an error.
// `loaded_valid` tells when all are written. Two clocks a field, then one for each vector and each entry.
module hmlfc_residual_parser #(
    parameter int BLOCK_LOG2 = 2,
    parameter int CONTEXTS = 8,
    parameter int CONTEXT_WORDS = 256,  // words of 64 bits of a context's part of the memory
    parameter int WINDOW_BITS = 256,
    parameter int SKEW_BITS = 7,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS),
    localparam int WORD_BITS = $clog2(CONTEXTS * CONTEXT_WORDS),
    localparam int BIAS_BITS = 14,
    localparam int VECTOR_BITS = 18,
    localparam int ENTRY_BITS = 6 + 6 + 4 + BIAS_BITS + POSITION_BITS
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

    // Two read ports of the record memory; the second is for vertical components only.
    output logic [1:0] read_enable,
    output logic [2*WORD_BITS-1:0] read_word,
    input logic [2*WINDOW_BITS-1:0] window,

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
    output logic [CONTEXT_BITS-1:0] loaded_context,
    output logic loaded_keep
);

  localparam int SAMPLES = 1 << (2 * BLOCK_LOG2);
  localparam int P = POSITION_BITS;

  typedef enum logic [3:0] {
    IDLE,
    MODES,
    MOTION_MASK,
    RESIDUAL_MASK,
    CHECK,
    BOUNDS,
    SIGNS,
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

  // The 64 bits at `position` are in `field` when `fresh`.
  logic fresh;
  logic [5:0] shift;
  wire [P-1:0] address = position + P'(skew);
  wire [79:0] field = 80'(window[WINDOW_BITS-1:0] >> shift);

  function automatic logic [6:0] count_ones(input logic [63:0] mask);
    count_ones = '0;
    for (int i = 0; i < 64; i++) count_ones = count_ones + 7'(mask[i]);
  endfunction

  // Mask mode 3 (TIL-3): 4 bits for each quad of `quads`, packed in `blocks`.
  function automatic logic [63:0] quad_mask(input logic [15:0] quads, input logic [63:0] blocks);
    logic [5:0] at;
    at = '0;
    quad_mask = '0;
    for (int q = 0; q < 16; q++) begin
      if (quads[q]) begin
        quad_mask[4*q+:4] = 4'(blocks >> at);
        at = at + 6'd4;
      end
    end
  endfunction

  // The blocks in the plane, as a mask (TIL-2).
  function automatic logic [63:0] inside_mask(input logic [3:0] columns_in, input logic [3:0] rows_in);
    for (int k = 0; k < 64; k++) begin
      inside_mask[k] = 4'(2 * ((k >> 2) & 3) + (k & 1)) < columns_in && 4'(2 * (k >> 4) + ((k >> 1) & 1)) < rows_in;
    end
  endfunction

  // TIL-6: the bits v of a component's bound, the greatest level code K and its bits c.
  wire [7:0] twice_window = {stream.window, 1'b0};
  logic [3:0] component_bits, code_bits;
  logic [5:0] max_code;
  always_comb begin
    component_bits = '0;
    for (int i = 0; i < 8; i++) if (twice_window[i]) component_bits = 4'(i + 1);
    max_code = '0;
    for (int i = 21; i >= 0; i--) if (hmlfc_level_count(6'(i)) > 15'(twice_window)) max_code = 6'(i);
    code_bits = '0;
    for (int i = 0; i < 6; i++) if (max_code[i]) code_bits = 4'(i + 1);
  end

  wire [63:0] in_plane = inside_mask(columns, rows);
  logic [1:0] motion_mode, residual_mode;
  logic [63:0] motion_mask, residual_mask;
  wire [1:0] mask_mode = state == MOTION_MASK ? motion_mode : residual_mode;
  logic [63:0] mask;
  logic [6:0] mask_bits;
  wire [6:0] quads = count_ones(64'(field[15:0]));
  always_comb begin
    mask = '0;
    mask_bits = '0;
    case (mask_mode)
      2'd1: mask = in_plane;
      2'd2: begin
        mask = field[63:0];
        mask_bits = 7'd64;
      end
      2'd3: begin
        mask = quad_mask(field[15:0], field[79:16]);
        mask_bits = 7'd16 + {quads[4:0], 2'b00};
      end
      default: ;
    endcase
  end

  // Fields of TIL-6, each a shift after the one before.
  wire [7:0] component_mask = ~(8'hFF << component_bits);
  wire [5:0] code_mask = ~(6'h3F << code_bits);
  wire [4:0] bound_bits = 5'(component_bits) + 5'(code_bits);
  wire [29:0] bounds_x = field[31:2];
  wire [29:0] bounds_y = bounds_x >> bound_bits;
  wire [7:0] min_x_field = bounds_x[7:0] & component_mask;
  wire [5:0] codes_x_field = 6'(bounds_x >> component_bits) & code_mask;
  wire [7:0] min_y_field = bounds_y[7:0] & component_mask;
  wire [5:0] codes_y_field = 6'(bounds_y >> component_bits) & code_mask;
  logic [5:0] bounds_error;
  wire [P-1:0] after_sign_mode = position + 2;
  wire [P-1:0] after_min_x = after_sign_mode + P'(component_bits);
  wire [P-1:0] after_codes_x = after_sign_mode + P'(bound_bits);
  wire [P-1:0] after_min_y = after_codes_x + P'(component_bits);
  wire [P-1:0] after_codes_y = after_codes_x + P'(bound_bits);
  always_comb begin
    bounds_error = '0;
    if (after_sign_mode > bits) bounds_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (field[1:0] == 2'd3) bounds_error = HMLFC_ERROR_BAD_MODE;
    else if (after_min_x > bits) bounds_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (min_x_field > twice_window) bounds_error = HMLFC_ERROR_VECTOR_RANGE;
    else if (after_codes_x > bits) bounds_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (codes_x_field > max_code) bounds_error = HMLFC_ERROR_BAD_LEVELS;
    else if (after_min_y > bits) bounds_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (min_y_field > twice_window) bounds_error = HMLFC_ERROR_VECTOR_RANGE;
    else if (after_codes_y > bits) bounds_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (codes_y_field > max_code) bounds_error = HMLFC_ERROR_BAD_LEVELS;
  end

  logic [1:0] sign_mode;
  logic signed [8:0] min_x, min_y;
  logic [5:0] codes_x, codes_y;
  logic [63:0] signs;
  logic [6:0] motion_count, residual_count;
  logic [13:0] bits_x, bits_y;
  hmlfc_bise_bits size_x (
      .count(11'(motion_count)),
      .level_code(codes_x),
      .bits(bits_x)
  );
  hmlfc_bise_bits size_y (
      .count(11'(motion_count)),
      .level_code(codes_y),
      .bits(bits_y)
  );
  wire [P-1:0] x_at = position + (sign_mode == 2'd2 ? P'(motion_count) : P'(0));  // in SIGNS
  wire [P-1:0] y_at = x_at + P'(bits_x);
  wire [P-1:0] vectors_end = y_at + P'(bits_y);
  logic [P-1:0] x_position, y_position;

  // Fields of TIL-8 and STP-1.
  logic [5:0] level_base;
  logic [2:0] level_bits;
  logic [3:0] bias_bits, step_base;
  logic [1:0] step_bits;
  wire steps = stream.features.residual_step;
  logic [5:0] residuals_error;
  always_comb begin
    residuals_error = '0;
    if (position + P'(9) > bits) residuals_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (field[8:6] > 3'd6) residuals_error = HMLFC_ERROR_BAD_MODE;
    else if (position + P'(13) > bits) residuals_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (5'(field[12:9]) > 5'(stream.depth) + 5'd2) residuals_error = HMLFC_ERROR_BAD_MODE;
  end
  wire [4:0] header_bits = 5'(level_bits) + 5'(bias_bits) + 5'(step_bits);

  // The passes over vectors and headers: item `number` is asked for in this clock.
  logic [6:0] number;
  wire [P-1:0] headers_end = position + P'(residual_count) * P'(header_bits);

  // Vectors: both components take 4 clocks.
  logic signed [8:0] dx, dy;
  wire [WORD_BITS+5-CONTEXT_BITS:0] x_in_context = (WORD_BITS + 6 - CONTEXT_BITS)'(x_position + P'(skew));
  wire [WORD_BITS+5-CONTEXT_BITS:0] y_in_context = (WORD_BITS + 6 - CONTEXT_BITS)'(y_position + P'(skew));
  wire [WORD_BITS+5:0] x_from = {context_number, x_in_context};
  wire [WORD_BITS+5:0] y_from = {context_number, y_in_context};
  logic [7:0] value_x, value_y;
  logic read_x_enable, read_y_enable;
  logic [WORD_BITS-1:0] read_x_word, read_y_word;
  hmlfc_element_reader #(
      .WORD_BITS(WORD_BITS),
      .VALUE_BITS(8),
      .WINDOW_BITS(WINDOW_BITS)
  ) reader_x (
      .clk,
      .advance(1'b1),
      .position(x_from),
      .total(bits_x),
      .level_code(codes_x),
      .index(10'(number)),
      .value(value_x),
      .read_enable(read_x_enable),
      .read_word(read_x_word),
      .window(window[WINDOW_BITS-1:0])
  );
  hmlfc_element_reader #(
      .WORD_BITS(WORD_BITS),
      .VALUE_BITS(8),
      .WINDOW_BITS(WINDOW_BITS)
  ) reader_y (
      .clk,
      .advance(1'b1),
      .position(y_from),
      .total(bits_y),
      .level_code(codes_y),
      .index(10'(number)),
      .value(value_y),
      .read_enable(read_y_enable),
      .read_word(read_y_word),
      .window(window[2*WINDOW_BITS-1:WINDOW_BITS])
  );
  wire asks_vector = state == VECTORS && number < motion_count;
  logic [3:0] vector_valid;
  logic [4*6-1:0] vector_numbers;
  wire signed [8:0] limit = 9'(stream.window);
  always_comb begin
    dx = min_x + $signed({1'b0, value_x});
    dy = min_y + $signed({1'b0, value_y});
    vector_write = vector_valid[3];
    vector_number = vector_numbers[18+:6];
    vector_data = {dx > limit || dy > limit, signs[vector_number], dy[7:0], dx[7:0]};
  end

  // Headers: asked for, at hand in the next clock, written in the one after.
  wire asks_header = state == HEADERS && number < residual_count;
  logic header_valid_1, header_valid_2, header_error;
  logic [5:0] header_number_1, header_number_2, level_code;
  logic [3:0] step_code;
  logic signed [BIAS_BITS-1:0] bias;
  logic [P-1:0] values_at;
  wire [5:0] level_mask = ~(6'h3F << level_bits);
  wire [2:0] step_mask = ~(3'h7 << step_bits);
  wire [15:0] bias_mask = ~(16'hFFFF << bias_bits);
  wire [5:0] level_delta = field[5:0] & level_mask;
  wire [6:0] code_sum = 7'(level_base) + 7'(level_delta);
  wire [2:0] step_delta = 3'(field[10:0] >> level_bits) & step_mask;
  wire [4:0] step_sum = 5'(step_base) + 5'(step_delta);
  wire [15:0] bias_field = 16'(field[31:0] >> (5'(level_bits) + 5'(step_bits))) & bias_mask;
  wire bias_negative = bias_bits != 0 && bias_field[bias_bits-4'd1];
  wire [P-1:0] values_end = values_at + P'(hmlfc_plain_bits(level_code)) * P'(SAMPLES) +
      (hmlfc_digit_kind(level_code) == HMLFC_DIGIT_TRIT ? P'((8 * SAMPLES + 4) / 5) :
       hmlfc_digit_kind(level_code) == HMLFC_DIGIT_QUINT ? P'((7 * SAMPLES + 2) / 3) : P'(0));
  wire bad_codes = code_sum > 7'(hmlfc_max_level_code(stream.depth)) || step_sum > 5'(HMLFC_MAX_STEP_CODE);
  wire [P-1:0] values_from = values_at + P'(skew);
  always_comb begin
    entry_write = header_valid_2;
    entry_number = header_number_2;
    entry_data = {
      header_error ? HMLFC_ERROR_BAD_LEVELS : values_end > bits ? HMLFC_ERROR_TILE_OVERRUN : 6'd0,
      level_code,
      step_code,
      bias,
      values_from
    };
  end

  assign parse_ready = state == IDLE;
  assign read_enable = {read_y_enable, state == VECTORS ? read_x_enable : 1'b1};
  assign read_word = {
    read_y_word,
    state == VECTORS ? read_x_word : {context_number, (WORD_BITS - CONTEXT_BITS)'(address >> 6)}
  };
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
    case (state)
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
      if (fresh) begin
        if (state == MOTION_MASK) motion_mask <= mask;
        else residual_mask <= mask;
        position <= position + P'(mask_bits);
        fresh <= 1'b0;
        state <= state == MOTION_MASK ? RESIDUAL_MASK : CHECK;
      end
      CHECK: begin
        motion_count <= count_ones(motion_mask);
        residual_count <= count_ones(residual_mask);
        if (position > bits) error <= HMLFC_ERROR_TILE_OVERRUN;
        else if (((motion_mask | residual_mask) & ~in_plane) != 0) error <= HMLFC_ERROR_MASK_OUTSIDE;
        if (position > bits || ((motion_mask | residual_mask) & ~in_plane) != 0) state <= FINISH;
        else if (motion_mask != 0) state <= BOUNDS;
        else state <= residual_mask != 0 ? RESIDUALS : FINISH;
      end
      BOUNDS:
      if (fresh) begin
        sign_mode <= field[1:0];
        min_x <= 9'(min_x_field) - limit;
        min_y <= 9'(min_y_field) - limit;
        codes_x <= codes_x_field;
        codes_y <= codes_y_field;
        position <= after_codes_y;
        fresh <= 1'b0;
        error <= bounds_error;
        state <= bounds_error != 0 ? FINISH : SIGNS;
      end
      SIGNS:
      if (fresh) begin
        signs <= sign_mode == 2'd2 ? field[63:0] : {64{sign_mode[0]}};
        x_position <= x_at;
        y_position <= y_at;
        position <= vectors_end;
        fresh <= 1'b0;
        number <= '0;
        if (vectors_end > bits) error <= HMLFC_ERROR_TILE_OVERRUN;
        state <= vectors_end > bits ? FINISH : VECTORS;
      end
      VECTORS: begin
        number <= number + 1'b1;
        if (number == motion_count + 7'd3) begin
          fresh <= 1'b0;
          state <= residual_mask != 0 ? RESIDUALS : FINISH;
        end
      end
      RESIDUALS:
      if (fresh) begin
        level_base <= field[5:0];
        level_bits <= field[8:6];
        bias_bits <= field[12:9];
        step_base <= steps ? field[16:13] : 4'd0;
        step_bits <= steps ? field[18:17] : 2'd0;
        position <= position + (steps ? P'(19) : P'(13));
        fresh <= 1'b0;
        number <= '0;
        header_error <= 1'b0;
        error <= residuals_error;
        state <= residuals_error != 0 ? FINISH : HEADERS;
      end
      HEADERS: begin
        if (number == 0) begin
          values_at <= headers_end;
          if (headers_end > bits) error <= HMLFC_ERROR_TILE_OVERRUN;
        end
        number <= number + 1'b1;
        position <= position + P'(header_bits);
        if (number == 0 && headers_end > bits) state <= FINISH;
        else if (number + 7'd1 == residual_count) state <= DRAIN;
      end
      DRAIN: if (!header_valid_1) state <= FINISH;
      FINISH: state <= IDLE;
      default: state <= IDLE;
    endcase

    vector_valid <= {vector_valid[2:0], asks_vector};
    vector_numbers <= {vector_numbers[17:0], number[5:0]};

    header_valid_1 <= asks_header && !(number == 0 && headers_end > bits);
    header_number_1 <= number[5:0];
    header_valid_2 <= header_valid_1;
    header_number_2 <= header_number_1;
    if (header_valid_1) begin
      level_code <= code_sum[5:0];
      step_code <= step_sum[3:0];
      bias <= BIAS_BITS'(bias_negative ? bias_field | ~bias_mask : bias_field);
      header_error <= header_error || bad_codes;
    end
    if (header_valid_2) values_at <= values_end;

    if (!rst_n) begin
      state <= IDLE;
      vector_valid <= '0;
      header_valid_1 <= 1'b0;
      header_valid_2 <= 1'b0;
    end
  end

endmodule
