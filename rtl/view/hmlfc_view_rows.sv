// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// From an answer to the rows of its block as bytes of memory lines (64 bytes), one row a clock.
//
// A block is taken with its place. A row comes out three clocks later as `line`, its number in memory, and `data` and
// `strobe`, rotated to their places in lines of 64 bytes; with `wraps` the bytes of `strobe_next` belong to the next
// line. `blank`: the block has an error, or a pixel of the rectangle does not fit the format (`error` is then
// limit_exceeded), and its pixels are 0.
// Addresses are multiples of B, which formats keep where destinations and pitches are multiples of 16.
module hmlfc_view_rows #(
    parameter int BLOCK_LOG2 = 2,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int B = 1 << BLOCK_LOG2,
    localparam int LANE_BITS = B * B * 16
) (
    input logic clk,
    input logic rst_n,
    input logic [2:0] format,
    input logic [23:0] pitch,

    input logic in_valid,
    output logic in_ready,
    input logic [3*LANE_BITS-1:0] in_samples,
    input logic [5:0] in_status,
    input logic [2:0] in_end_column,
    input logic [2:0] in_end_row,
    input logic in_lower,  // of the two blocks of a quad's column
    input logic [ADDRESS_BITS-1:0] in_address,
    output logic [5:0] error,  // of the block that is offered

    output logic out_valid,
    input logic out_ready,
    output logic [BLOCK_LOG2:0] out_entry,  // the row in its quad
    output logic [ADDRESS_BITS-7:0] out_line,
    output logic [ADDRESS_BITS-7:0] out_line_next,  // the one behind it
    output logic [511:0] out_data,
    output logic [63:0] out_strobe,
    output logic [63:0] out_strobe_next,
    output logic out_wraps,
    output logic empty
);

  localparam int ROW_BYTES = 6 * B;

  // Whether a pixel in the rectangle does not fit.
  logic too_large;
  always_comb begin
    too_large = 1'b0;
    for (int i = 0; i < 3 * B * B; i++) begin
      if (3'(i % B) <= in_end_column && 3'(i / B % B) <= in_end_row) begin
        if (format == hmlfc_pkg::FORMAT_RGB888 && in_samples[16*i+8+:8] != 0) too_large = 1'b1;
        if (format == hmlfc_pkg::FORMAT_RGB101010 && in_samples[16*i+10+:6] != 0) too_large = 1'b1;
      end
    end
  end
  assign error = in_status != 0 ? in_status : too_large ? HMLFC_ERROR_LIMIT_EXCEEDED : 6'd0;

  // Bytes of a row of the rectangle in the block.
  logic [3:0] columns;
  logic [5:0] row_size;
  assign columns = {1'b0, in_end_column} + 4'd1;
  always_comb begin
    unique case (format)
      hmlfc_pkg::FORMAT_RGB888: row_size = {1'b0, columns, 1'b0} + {2'd0, columns};
      hmlfc_pkg::FORMAT_RGB101010: row_size = {columns, 2'd0};
      hmlfc_pkg::FORMAT_RGB161616: row_size = {columns, 2'd0} + {1'b0, columns, 1'b0};
      default: row_size = {1'b0, columns, 1'b0};
    endcase
  end

  // ---- The block: its first row in the low bits of each lane.
  logic held, blank, lower;
  logic [LANE_BITS-1:0] lane_0, lane_1, lane_2;
  logic [2:0] row, end_row;
  logic [5:0] size;
  logic [ADDRESS_BITS-1:0] address;
  logic packed_ready;
  wire take = in_valid && in_ready;
  wire give = held && packed_ready;
  assign in_ready = !held || (give && row == end_row);
  always_ff @(posedge clk) begin
    if (take) begin
      {lane_2, lane_1, lane_0} <= in_samples;
      blank <= error != 0;
      lower <= in_lower;
      row <= '0;
      end_row <= in_end_row;
      size <= row_size;
      address <= in_address;
    end else if (give) begin
      lane_0 <= lane_0 >> (16 * B);
      lane_1 <= lane_1 >> (16 * B);
      lane_2 <= lane_2 >> (16 * B);
      row <= row + 3'd1;
      address <= address + ADDRESS_BITS'(pitch);
    end
    if (!rst_n) held <= 1'b0;
    else held <= take || (held && !(give && row == end_row));
  end

  // ---- Its row in the format.
  logic [8*ROW_BYTES-1:0] bytes;
  always_comb begin
    bytes = '0;
    for (int i = 0; i < B; i++) begin
      unique case (format)
        hmlfc_pkg::FORMAT_RGB888: bytes[24*i+:24] = {lane_2[16*i+:8], lane_1[16*i+:8], lane_0[16*i+:8]};
        hmlfc_pkg::FORMAT_RGB101010: bytes[32*i+:32] = {2'd0, lane_2[16*i+:10], lane_1[16*i+:10], lane_0[16*i+:10]};
        hmlfc_pkg::FORMAT_RGB161616: bytes[48*i+:48] = {lane_2[16*i+:16], lane_1[16*i+:16], lane_0[16*i+:16]};
        default: bytes[16*i+:16] = lane_0[16*i+:16];
      endcase
    end
    if (blank) bytes = '0;
  end

  logic packed_valid, line_ready;
  logic [8*ROW_BYTES-1:0] packed_bytes;
  logic [5:0] packed_size;
  logic [ADDRESS_BITS-1:0] packed_address;
  logic [BLOCK_LOG2:0] packed_entry;
  assign packed_ready = !packed_valid || line_ready;
  always_ff @(posedge clk) begin
    if (packed_ready) begin
      packed_bytes <= bytes;
      packed_size <= size;
      packed_address <= address;
      packed_entry <= {lower, row[BLOCK_LOG2-1:0]};
    end
    if (!rst_n) packed_valid <= 1'b0;
    else if (packed_ready) packed_valid <= held;
  end

  // ---- The row in its line. Bytes without a strobe may be anything: the line repeats what the row turns in.
  localparam int TURN_LOG2 = BLOCK_LOG2 + 3;  // of its bytes
  localparam int TURN_BITS = 8 << TURN_LOG2;
  logic [63:0] row_strobe, turned_strobe, below_start;
  logic [2*TURN_BITS-1:0] twice;
  logic [127:0] twice_strobe;
  always_comb begin
    for (int i = 0; i < 64; i++) begin
      row_strobe[i] = 6'(i) < packed_size;
      below_start[i] = 6'(i) < {packed_address[5:BLOCK_LOG2], BLOCK_LOG2'(0)};
    end
    twice = (2 * TURN_BITS)'(packed_bytes) << {packed_address[TURN_LOG2-1:BLOCK_LOG2], (BLOCK_LOG2 + 3)'(0)};
    twice_strobe = {64'd0, row_strobe} << {packed_address[5:BLOCK_LOG2], BLOCK_LOG2'(0)};
    turned_strobe = twice_strobe[63:0] | twice_strobe[127:64];
  end
  assign line_ready = !out_valid || out_ready;
  always_ff @(posedge clk) begin
    if (line_ready) begin
      out_entry <= packed_entry;
      out_line <= packed_address[ADDRESS_BITS-1:6];
      out_line_next <= packed_address[ADDRESS_BITS-1:6] + 1'b1;
      out_data <= {(512 / TURN_BITS) {twice[TURN_BITS-1:0] | twice[2*TURN_BITS-1:TURN_BITS]}};
      out_strobe <= turned_strobe & ~below_start;
      out_strobe_next <= turned_strobe & below_start;
      out_wraps <= twice_strobe[127:64] != 0;
    end
    if (!rst_n) out_valid <= 1'b0;
    else if (line_ready) out_valid <= packed_valid;
  end
  assign empty = !held && !packed_valid && !out_valid;

endmodule

`default_nettype wire
