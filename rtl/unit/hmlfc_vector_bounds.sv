// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// The fields of TIL-6 that begin in `field`: how the vectors of a residual tile are coded.
//
// search_window  w of the header, for 25 clocks at least
// position, bits  of the field in its record, [4, 164] (TIL-1 to TIL-3), and the record's length, not less
// error  the first of annex A in the order of the fields, 0 for none; with an error the rest has no meaning
// min_x, min_y  least components, [-w, w]
// next   position behind the fields
// Combinational but for what depends on w alone.
module hmlfc_vector_bounds #(
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic [6:0] search_window,
    input logic [28:0] field,
    input logic [POSITION_BITS-1:0] position,
    input logic [POSITION_BITS-1:0] bits,
    output logic [5:0] error,
    output logic [1:0] sign_mode,
    output logic signed [8:0] min_x,
    output logic signed [8:0] min_y,
    output logic [5:0] codes_x,
    output logic [5:0] codes_y,
    output logic [POSITION_BITS-1:0] next
);

  localparam int P = POSITION_BITS;

  // The bits v of a component's bound, the greatest level code K and its bits c, which are those of the stream.
  wire [7:0] twice_window = {search_window, 1'b0};
  logic [3:0] component_bits;  // at most 8
  logic [2:0] code_bits;       // at most 5
  logic [4:0] max_code;
  logic [6:0] counted_window;  // for which max_code goes up to its value
  always_ff @(posedge clk) begin
    counted_window <= search_window;
    if (!rst_n || counted_window != search_window) max_code <= '0;
    else if (hmlfc_level_count(6'(max_code)) <= 15'(twice_window)) max_code <= max_code + 1'b1;
    component_bits <= '0;
    for (int i = 0; i < 8; i++) if (twice_window[i]) component_bits <= 4'(i + 1);
    code_bits <= '0;
    for (int i = 0; i < 5; i++) if (max_code[i]) code_bits <= 3'(i + 1);
  end

  // Each field is one shift after the previous one.
  wire [7:0] component_mask = ~(8'hFF << component_bits);
  wire [4:0] code_mask = ~(5'h1F << code_bits);
  wire [3:0] bound_bits = component_bits + 4'(code_bits);
  wire [26:0] bounds_x = field[28:2];
  wire [13:0] bounds_y = 14'(bounds_x >> bound_bits);
  wire [7:0] min_x_field = bounds_x[7:0] & component_mask;
  wire [7:0] min_y_field = bounds_y[7:0] & component_mask;
  wire signed [8:0] limit = 9'(search_window);
  assign sign_mode = field[1:0];
  assign min_x = 9'(min_x_field) - limit;
  assign min_y = 9'(min_y_field) - limit;
  assign codes_x = {1'b0, 5'(bounds_x >> component_bits) & code_mask};
  assign codes_y = {1'b0, 5'(bounds_y >> component_bits) & code_mask};

  // Where the fields end, in bits behind `position`, and how many bits the record has there, 63 for more.
  wire [4:0] after_min_x = 5'd2 + 5'(component_bits);
  wire [4:0] after_codes_x = 5'd2 + 5'(bound_bits);
  wire [4:0] after_min_y = after_codes_x + 5'(component_bits);
  wire [4:0] end_bits = after_codes_x + 5'(bound_bits);
  wire [P-1:0] behind = bits - position;
  wire [5:0] left = behind[P-1:6] != 0 ? 6'd63 : behind[5:0];
  assign next = position + P'(end_bits);
  always_comb begin
    error = '0;
    if (left < 6'd2) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (sign_mode == 2'd3) error = HMLFC_ERROR_BAD_MODE;
    else if (6'(after_min_x) > left) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (min_x_field > twice_window) error = HMLFC_ERROR_VECTOR_RANGE;
    else if (6'(after_codes_x) > left) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (codes_x > 6'(max_code)) error = HMLFC_ERROR_BAD_LEVELS;
    else if (6'(after_min_y) > left) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (min_y_field > twice_window) error = HMLFC_ERROR_VECTOR_RANGE;
    else if (6'(end_bits) > left) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (codes_y > 6'(max_code)) error = HMLFC_ERROR_BAD_LEVELS;
  end

endmodule

`default_nettype wire
