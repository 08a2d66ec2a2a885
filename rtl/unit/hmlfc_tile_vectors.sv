// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Lists the vectors of a residual tile (TIL-7), one a clock.
//
// `start` takes the place of the components; count and codes keep from two clocks before, bounds and signs from then
// on. `placed`, 2 clocks later: `next` holds.
// While `active`, from then on, it asks for vector after vector, and writes each 4 clocks later; `last`: the last is
// written in this clock. The horizontal components are read through read port 0, the vertical ones through port 1.
module hmlfc_tile_vectors #(
    parameter int WORD_BITS = 10,  // of word addresses of the record memory
    parameter int PLACE_BITS = 14,  // of bit positions in a context's part of it
    parameter int WINDOW_BITS = 256,
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

    output logic [1:0] read_enable,
    output logic [2*WORD_BITS-1:0] read_word,
    input logic [2*WINDOW_BITS-1:0] window,

    output logic vector_write,
    output logic [5:0] vector_number,
    output logic [VECTOR_BITS-1:0] vector_data  // {vector_range, sign, dy, dx}
);

  // Where the components are: the vertical ones behind the horizontal ones, one clock after `start`; their end, in the
  // next.
  logic [13:0] bits_x, bits_y;
  hmlfc_bise_bits size_x (
      .clk,
      .count(11'(count)),
      .level_code(codes_x),
      .bits(bits_x)
  );
  hmlfc_bise_bits size_y (
      .clk,
      .count(11'(count)),
      .level_code(codes_y),
      .bits(bits_y)
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

  logic [6:0] number;  // of the vector that is requested
  logic [7:0] value_x, value_y;
  hmlfc_element_reader #(
      .WORD_BITS(WORD_BITS),
      .VALUE_BITS(8),
      .WINDOW_BITS(WINDOW_BITS)
  ) reader_x (
      .clk,
      .advance(1'b1),
      .position({context_number, x_place}),
      .total(bits_x),
      .level_code(codes_x),
      .index(10'(number)),
      .value(value_x),
      .read_enable(read_enable[0]),
      .read_word(read_word[WORD_BITS-1:0]),
      .window(window[WINDOW_BITS-1:0])
  );
  hmlfc_element_reader #(
      .WORD_BITS(WORD_BITS),
      .VALUE_BITS(8),
      .WINDOW_BITS(WINDOW_BITS)
  ) reader_y (
      .clk,
      .advance(1'b1),
      .position({context_number, y_place}),
      .total(bits_y),
      .level_code(codes_y),
      .index(10'(number)),
      .value(value_y),
      .read_enable(read_enable[1]),
      .read_word(read_word[2*WORD_BITS-1:WORD_BITS]),
      .window(window[2*WINDOW_BITS-1:WINDOW_BITS])
  );

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
    if (active) number <= number + 1'b1;
    valid <= {valid[2:0], active && number < count};
    numbers <= {numbers[17:0], number[5:0]};
    if (!rst_n) valid <= '0;
  end

endmodule

`default_nettype wire
