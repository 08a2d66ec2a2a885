// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Lists the blocks with a residual of a tile: their headers and where their values begin (TIL-8, STP-1), one a clock.
//
// `start` takes the fields that all headers share from `field`; they take `shared_bits`, and `shared_error` is the
// first error in them. While `active`, `field` is to hold header after header, each `header_bits` after the previous
// one; with LATE a clock later, as in `start`. An entry is written 2 clocks later, 3 with LATE. `overrun`, in the first
// clock of `active`: the headers do not fit the record, and none is listed. `last`: the last header is at hand;
// `pending`: one is still to be written behind this clock.
module hmlfc_tile_headers #(
    parameter int BLOCK_LOG2 = 2,
    parameter int SKEW_BITS = 7,
    parameter int LATE = 0,  // 0, 1
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int BIAS_BITS = 14,
    localparam int ENTRY_BITS = 6 + 6 + 4 + BIAS_BITS + POSITION_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic [6:0] count,  // of headers, [1, 64]
    input logic [3:0] depth,
    input logic steps,  // the stream has residual steps
    input logic [SKEW_BITS-1:0] skew,
    input logic [POSITION_BITS-1:0] bits,

    input logic [31:0] field,  // the bits at `position` of the record
    input logic [POSITION_BITS-1:0] position,
    input logic start,
    output logic [5:0] shared_error,
    output logic [4:0] shared_bits,

    input logic active,
    output logic [4:0] header_bits,
    output logic overrun,
    output logic last,
    output logic pending,

    output logic entry_write,
    output logic [5:0] entry_number,
    output logic [ENTRY_BITS-1:0] entry_data  // {error, level code, step code, bias, position of the values}
);

  localparam int SAMPLES = 1 << (2 * BLOCK_LOG2);
  localparam int P = POSITION_BITS;

  // The shared fields.
  logic [5:0] level_base;
  logic [2:0] level_bits;
  logic [3:0] bias_bits, step_base;
  logic [1:0] step_bits;
  assign shared_bits = steps ? 5'd19 : 5'd13;
  assign header_bits = 5'(level_bits) + 5'(bias_bits) + 5'(step_bits);
  always_comb begin
    shared_error = '0;
    if (position + P'(9) > bits) shared_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (field[8:6] > 3'd6) shared_error = HMLFC_ERROR_BAD_MODE;
    else if (position + P'(13) > bits) shared_error = HMLFC_ERROR_TILE_OVERRUN;
    else if (5'(field[12:9]) > 5'(depth) + 5'd2) shared_error = HMLFC_ERROR_BAD_MODE;
  end

  // A header is requested in this clock, at hand in the next, or with LATE in the one after, written in the next.
  logic [6:0] number;
  logic requested;
  logic [5:0] number_requested;
  wire [P-1:0] headers_end = position + P'(count) * P'(header_bits);
  logic at_hand, error;
  logic [5:0] number_at_hand, level_code;
  logic [3:0] step_code;
  logic signed [BIAS_BITS-1:0] bias;
  logic [P-1:0] values_at;
  assign overrun = number == 0 && headers_end > bits;
  assign last = number + 7'd1 == count;
  assign pending = at_hand || (LATE != 0 && requested);

  wire [5:0] level_mask = ~(6'h3F << level_bits);
  wire [2:0] step_mask = ~(3'h7 << step_bits);
  wire [15:0] bias_mask = ~(16'hFFFF << bias_bits);
  wire [5:0] level_delta = field[5:0] & level_mask;
  wire [6:0] code_sum = 7'(level_base) + 7'(level_delta);
  wire [2:0] step_delta = 3'(field[10:0] >> level_bits) & step_mask;
  wire [4:0] step_sum = 5'(step_base) + 5'(step_delta);
  wire [15:0] bias_field = 16'(field >> (5'(level_bits) + 5'(step_bits))) & bias_mask;
  wire bias_negative = bias_bits != 0 && bias_field[bias_bits-4'd1];
  wire bad_codes = code_sum > 7'(hmlfc_max_level_code(depth)) || step_sum > 5'(HMLFC_MAX_STEP_CODE);

  wire [P-1:0] values_end = values_at + P'(hmlfc_plain_bits(level_code)) * P'(SAMPLES) +
      (hmlfc_digit_kind(level_code) == HMLFC_DIGIT_TRIT ? P'((8 * SAMPLES + 4) / 5) :
       hmlfc_digit_kind(level_code) == HMLFC_DIGIT_QUINT ? P'((7 * SAMPLES + 2) / 3) : P'(0));
  wire [P-1:0] values_from = values_at + P'(skew);
  assign entry_data = {
    error ? HMLFC_ERROR_BAD_LEVELS : values_end > bits ? HMLFC_ERROR_TILE_OVERRUN : 6'd0,
    level_code,
    step_code,
    bias,
    values_from
  };

  always_ff @(posedge clk) begin
    if (start) begin
      level_base <= field[5:0];
      level_bits <= field[8:6];
      bias_bits <= field[12:9];
      step_base <= steps ? field[16:13] : 4'd0;
      step_bits <= steps ? field[18:17] : 2'd0;
      number <= '0;
      error <= 1'b0;
    end
    if (active) begin
      number <= number + 1'b1;
      if (number == 0) values_at <= headers_end;
    end
    {requested, number_requested} <= {active && !overrun, number[5:0]};
    {at_hand, number_at_hand} <= LATE != 0 ? {requested, number_requested} : {active && !overrun, number[5:0]};
    entry_write <= at_hand;
    entry_number <= number_at_hand;
    if (at_hand) begin
      level_code <= code_sum[5:0];
      step_code <= step_sum[3:0];
      bias <= BIAS_BITS'(bias_negative ? bias_field | ~bias_mask : bias_field);
      error <= error || bad_codes;
    end
    if (entry_write) values_at <= values_end;
    if (!rst_n) begin
      {requested, at_hand} <= 2'b00;
      entry_write <= 1'b0;
    end
  end

endmodule

`default_nettype wire
