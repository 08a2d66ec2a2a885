// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Lists the vectors of a residual tile (TIL-7), one a clock, or one in two clocks with one reader.
//
// `start` takes the place of the components; count and codes keep from two clocks before, bounds and signs from then
// on. `placed`, 2 clocks later: `next` holds.
// While `active`, from then on, it asks for vector after vector, and writes each 4 clocks later; `last`: all are
// written after this clock. The horizontal components are read through read port 0, the vertical ones through the last.
module hmlfc_tile_vectors #(
    parameter int WORD_BITS = 10,  // of word addresses of the record memory
    parameter int PLACE_BITS = 14,  // of bit positions in a context's part of it
    parameter int WINDOW_BITS = 256,
    parameter int READERS = 2,  // 1, 2
    localparam int CONTEXT_BITS = WORD_BITS + 6 - PLACE_BITS,
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS,
    localparam int VECTOR_BITS = 18
) (
    input logic clk,
    input logic rst_n,

    input logic [6:0] count,  // of vectors, [1, 64]
    input logic signed [8:0] min_x,
    input logic signed [8:0] min_y,
    input logic [5:0] codes_x,
    input logic [5:0] codes_y,
    input logic [63:0] signs,
    input logic [6:0] search_window,

    input logic [POSITION_BITS-1:0] position,  // of the components in the record
    input logic start,
    output logic placed,
    output logic [POSITION_BITS-1:0] next,  // behind the components
    input logic [CONTEXT_BITS-1:0] context_number,
    input logic [PLACE_BITS-1:0] skew,  // of the record in its context's part
    input logic active,
    output logic last,

    output logic [READERS-1:0] read_enable,
    output logic [READERS*WORD_BITS-1:0] read_word,
    input logic [READERS*WINDOW_BITS-1:0] window,

    output logic vector_write,
    output logic [5:0] vector_number,
    output logic [VECTOR_BITS-1:0] vector_data  // {vector_range, sign, dy, dx}
);

  // Where the components are: the vertical ones behind the horizontal ones, one clock after `start`; their end, in the
  // next.
  logic [13:0] bits_x, bits_y;
  hmlfc_bise_bits size_x (
      .clk, .count(11'(count)), .level_code(codes_x), .bits(bits_x)
  );
  hmlfc_bise_bits size_y (
      .clk, .count(11'(count)), .level_code(codes_y), .bits(bits_y)
  );
  logic [POSITION_BITS-1:0] y_position;
  logic [PLACE_BITS-1:0] x_place, y_place;
  logic placing;
  always_ff @(posedge clk) begin
    if (start) begin
      x_place <= PLACE_BITS'(position) + skew;
      y_position <= position + POSITION_BITS'(bits_x);
    end
    if (placing) begin
      y_place <= PLACE_BITS'(y_position) + skew;
      next <= y_position + POSITION_BITS'(bits_y);
    end
    {placed, placing} <= rst_n ? {placing, start} : 2'b00;
  end

  // One reader takes x and y in turn, two take them together.
  logic [6:0] number;  // of the vector that is requested
  logic of_y;
  wire whole = READERS == 2 || of_y;
  logic [READERS*8-1:0] values;
  logic [7:0] value_x;
  for (genvar r = 0; r < READERS; r++) begin : g_reader
    wire y = READERS == 2 ? 1'(r) : of_y;
    hmlfc_element_reader #(.WORD_BITS(WORD_BITS), .VALUE_BITS(8), .WINDOW_BITS(WINDOW_BITS)) reader (
        .clk, .advance(1'b1), .position({context_number, y ? y_place : x_place}), .total(y ? bits_y : bits_x),
        .level_code(y ? codes_y : codes_x), .index(10'(number)), .value(values[r*8+:8]), .read_enable(read_enable[r]),
        .read_word(read_word[r*WORD_BITS+:WORD_BITS]), .window(window[r*WINDOW_BITS+:WINDOW_BITS])
    );
  end
  if (READERS == 2) begin : g_together
    assign {of_y, value_x} = {1'b0, values[7:0]};
  end else begin : g_in_turn
    always_ff @(posedge clk) begin
      of_y <= active && !of_y;
      value_x <= values;
    end
  end
  wire [7:0] value_y = values[READERS*8-1-:8];

  logic [3:0] valid;  // what the readers hold
  logic [4*6-1:0] numbers;
  wire signed [9:0] dx = 10'(min_x) + $signed({2'b00, value_x});
  wire signed [9:0] dy = 10'(min_y) + $signed({2'b00, value_y});
  wire signed [9:0] limit = 10'(search_window);
  assign vector_write = valid[3];
  assign vector_number = numbers[18+:6];
  assign vector_data = {dx > limit || dy > limit, signs[vector_number], dy[7:0], dx[7:0]};
  assign last = number == count + 7'd3;

  always_ff @(posedge clk) begin
    if (start) number <= '0;
    if (active && whole) number <= number + 1'b1;
    valid <= {valid[2:0], active && whole && number < count};
    numbers <= {numbers[17:0], number[5:0]};
    if (!rst_n) valid <= '0;
  end

endmodule

`default_nettype wire
