// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Reads a descriptor from memory and checks it.
//
// `start` takes its `address`, a multiple of 64, when nothing is under way; `done` is high for one clock, and what it
// found holds until the next start: `view`, `tag`; `refused`: a field is outside its interval; `failed`: a beat came
// with SLVERR or DECERR, and `tag` is 0.
module hmlfc_view_fetch #(
    parameter int BLOCK_LOG2 = 2,
    parameter int DATA_BITS = 128,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input logic [ADDRESS_BITS-1:0] address,
    output logic done,
    output hmlfc_pkg::view_t view,
    output logic [31:0] tag,
    output logic refused,
    output logic failed,

    output logic ar_valid,
    input logic ar_ready,
    output logic [ADDRESS_BITS-1:0] ar_address,
    output logic [7:0] ar_len,
    input logic r_valid,
    input logic [DATA_BITS-1:0] r_data,
    input logic r_error,
    input logic r_last
);

  // The fields lie in the first 48 bytes.
  localparam int WORDS = 12;
  localparam int WORDS_OF_BEAT = DATA_BITS / 32;
  localparam int BEATS = WORDS / WORDS_OF_BEAT;
  logic [32*WORDS-1:0] words;
  logic [2:0] beat;
  logic reading, read_error, received;
  assign ar_len = 8'(BEATS - 1);

  always_ff @(posedge clk) begin
    if (start) begin
      ar_address <= address;
      beat <= '0;
      read_error <= 1'b0;
    end else if (reading && r_valid) begin
      beat <= beat + 3'd1;
      read_error <= read_error || r_error;
      for (int i = 0; i < BEATS; i++) if (beat == 3'(i)) words[i*DATA_BITS+:DATA_BITS] <= r_data;
    end
    if (!rst_n) begin
      ar_valid <= 1'b0;
      reading <= 1'b0;
      received <= 1'b0;
      done <= 1'b0;
    end else begin
      ar_valid <= start || (ar_valid && !ar_ready);
      reading <= start || (reading && !(r_valid && r_last));
      received <= reading && r_valid && r_last;
      done <= received;
    end
  end

  // Fields, and what they must keep.
  wire [15:0] x = words[79:64];
  wire [15:0] y = words[95:80];
  wire [15:0] width = words[111:96];
  wire [15:0] height = words[127:112];
  wire [3:0] format = words[63:60];
  wire [16:0] end_x = {1'b0, x} + {1'b0, width} - 17'd1;
  wire [16:0] end_y = {1'b0, y} + {1'b0, height} - 17'd1;
  wire residuals = format[3];
  wire format_known = format <= 4'd2 || (format >= 4'd4 && format <= 4'd6) || (format >= 4'd8 && format <= 4'd10);
  wire aligned = x[BLOCK_LOG2-1:0] == 0 && y[BLOCK_LOG2-1:0] == 0 && words[131:128] == 0 && words[195:192] == 0 &&
      words[258:256] == 0;
  wire in_range = width != 0 && height != 0 && end_x[16:14] == 0 && end_y[16:14] == 0 && words[191:168] == 0 &&
      words[223:216] == 0 &&
      words[319:296] == 0 && !(residuals && (x != 0 || y != 0 || words[295:256] != 0));
  always_ff @(posedge clk) begin
    if (received) begin
      failed <= read_error;
      refused <= !(format_known && aligned && in_range);
      tag <= read_error ? 32'd0 : words[31:0];
      view.row <= words[43:32];
      view.col <= words[55:44];
      view.stop_level <= words[59:56];
      view.format <= format[2:0];
      view.residuals <= residuals;
      view.blocks.first_x <= 13'(x[13:BLOCK_LOG2]);
      view.blocks.last_x <= 13'(end_x[13:BLOCK_LOG2]);
      view.blocks.first_y <= 13'(y[13:BLOCK_LOG2]);
      view.blocks.last_y <= 13'(end_y[13:BLOCK_LOG2]);
      view.end_column <= 3'(end_x[BLOCK_LOG2-1:0]);
      view.end_row <= 3'(end_y[BLOCK_LOG2-1:0]);
      view.destination <= words[167:128];
      view.pitch <= words[215:192];
      view.bitmap <= words[295:256];
    end
  end

endmodule

`default_nettype wire
