// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// The fields of TIL-6 that begin in `field`: how the vectors of a residual tile are coded.
//
// search_window  w of the header, for two clocks at least
// position, bits  of the field in its record, [4, 164] (TIL-1 to TIL-3), and the record's length
// error  the first of annex A in the order of the fields, 0 for none; with an error the rest has no meaning
// min_x, min_y  least components, [-w, w]
// next   position behind the fields
// Combinational but for what depends on w alone.
module hmlfc_vector_bounds #(
    localparam int POSITION_BITS = hmlfc_pkg::POSITION_BITS
) (
    input logic clk,
    input logic [6:0] search_window,
    input logic [31:0] field,
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
  logic [3:0] component_bits, code_bits;
  logic [5:0] max_code;
  always_ff @(posedge clk) begin
    component_bits <= '0;
    for (int i = 0; i < 8; i++) if (twice_window[i]) component_bits <= 4'(i + 1);
    max_code <= '0;
    for (int i = 21; i >= 0; i--) if (hmlfc_level_count(6'(i)) > 15'(twice_window)) max_code <= 6'(i);
    code_bits <= '0;
    for (int i = 0; i < 6; i++) if (max_code[i]) code_bits <= 4'(i + 1);
  end

  // Each field is one shift after the previous one.
  wire [7:0] component_mask = ~(8'hFF << component_bits);
  wire [5:0] code_mask = ~(6'h3F << code_bits);
  wire [4:0] bound_bits = 5'(component_bits) + 5'(code_bits);
  wire [29:0] bounds_x = field[31:2];
  wire [29:0] bounds_y = bounds_x >> bound_bits;
  wire [7:0] min_x_field = bounds_x[7:0] & component_mask;
  wire [7:0] min_y_field = bounds_y[7:0] & component_mask;
  wire signed [8:0] limit = 9'(search_window);
  assign sign_mode = field[1:0];
  assign min_x = 9'(min_x_field) - limit;
  assign min_y = 9'(min_y_field) - limit;
  assign codes_x = 6'(bounds_x >> component_bits) & code_mask;
  assign codes_y = 6'(bounds_y >> component_bits) & code_mask;

  wire [P-1:0] after_sign_mode = position + 2;
  wire [P-1:0] after_min_x = after_sign_mode + P'(component_bits);
  wire [P-1:0] after_codes_x = after_sign_mode + P'(bound_bits);
  wire [P-1:0] after_min_y = after_codes_x + P'(component_bits);
  assign next = after_codes_x + P'(bound_bits);
  always_comb begin
    error = '0;
    if (after_sign_mode > bits) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (sign_mode == 2'd3) error = HMLFC_ERROR_BAD_MODE;
    else if (after_min_x > bits) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (min_x_field > twice_window) error = HMLFC_ERROR_VECTOR_RANGE;
    else if (after_codes_x > bits) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (codes_x > max_code) error = HMLFC_ERROR_BAD_LEVELS;
    else if (after_min_y > bits) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (min_y_field > twice_window) error = HMLFC_ERROR_VECTOR_RANGE;
    else if (next > bits) error = HMLFC_ERROR_TILE_OVERRUN;
    else if (codes_y > max_code) error = HMLFC_ERROR_BAD_LEVELS;
  end

endmodule

`default_nettype wire
