// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Reads descriptors ahead of their begin, and checks them.
//
// Descriptor n lies at place n mod `ring_size`. `view` is the next one while `valid`; `take` removes it. `begun` counts
// those that have begun: the next one is still `view` while `holds` is high. At most AHEAD more are read, one burst
// each, in order. `refused`: a field is outside its interval; `failed`: a beat came with SLVERR or DECERR.
// Without `enable` what has not begun is forgotten, once what is on its way has come: it is read again later, since
// software may write it anew. `reading`: bursts are on their way; `busy`: the clock is needed.
module hmlfc_view_fetch #(
    parameter int BLOCK_LOG2 = 2,
    parameter int DATA_BITS = 128,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic enable,
    input logic [ADDRESS_BITS-1:0] ring_base,
    input logic [15:0] ring_size,
    input logic [15:0] producer,
    input logic [15:0] begun,
    input logic holds,
    output logic reading,
    output logic busy,

    output logic valid,
    input logic take,
    output hmlfc_pkg::view_t view,

    output logic ar_valid,
    input logic ar_ready,
    output logic [ADDRESS_BITS-1:0] ar_address,
    output logic [7:0] ar_len,
    input logic r_valid,
    input logic [DATA_BITS-1:0] r_data,
    input logic r_error,
    input logic r_last
);

  // ---- What is asked for.
  localparam int AHEAD = 3;
  logic [15:0] asked;  // descriptors
  logic [2:0] coming;  // bursts that have not come
  logic stale, received, checked;
  wire [15:0] ahead = asked - begun;
  wire ask = enable && !stale && asked != producer && ahead < 16'(AHEAD) && !ar_valid;
  wire forget = stale && !reading && !holds;
  wire [15:0] place = asked & (ring_size - 16'd1);
  assign reading = coming != 0 || received || checked;
  assign busy = ask || reading || ((stale || !enable) && asked != begun);
  always_ff @(posedge clk) begin
    if (ask) ar_address <= ring_base + {18'd0, place, 6'd0};
    if (!rst_n) begin
      asked <= '0;
      coming <= '0;
      stale <= 1'b0;
      ar_valid <= 1'b0;
    end else begin
      asked <= forget ? begun : asked + 16'(ask);
      coming <= coming + 3'(ask) - 3'(r_valid && r_last);
      stale <= (stale && !forget) || (!enable && asked != begun && !forget);
      ar_valid <= ask || (ar_valid && !ar_ready);
    end
  end

  // ---- The fields lie in the first 48 bytes.
  localparam int WORDS = 12;
  localparam int BEATS = (32 * WORDS + DATA_BITS - 1) / DATA_BITS;
  logic [BEATS*DATA_BITS-1:0] words;
  logic [2:0] beat;
  logic failed;
  assign ar_len = 8'(BEATS - 1);
  always_ff @(posedge clk) begin
    if (r_valid) begin
      failed <= r_error || (failed && beat != 0);
      for (int i = 0; i < BEATS; i++) if (beat == 3'(i)) words[i*DATA_BITS+:DATA_BITS] <= r_data;
    end
    if (!rst_n) begin
      beat <= '0;
      received <= 1'b0;
      checked <= 1'b0;
    end else begin
      if (r_valid) beat <= r_last ? 3'd0 : beat + 3'd1;
      received <= r_valid && r_last;
      checked <= received;
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
  hmlfc_pkg::view_t found;
  always_ff @(posedge clk) begin
    if (received) begin
      found.failed <= failed;
      found.refused <= !(format_known && aligned && in_range);
      found.tag <= failed ? 32'd0 : words[31:0];
      found.row <= words[43:32];
      found.col <= words[55:44];
      found.stop_level <= words[59:56];
      found.format <= format[2:0];
      found.residuals <= residuals;
      found.blocks.first_x <= 13'(x[13:BLOCK_LOG2]);
      found.blocks.last_x <= 13'(end_x[13:BLOCK_LOG2]);
      found.blocks.first_y <= 13'(y[13:BLOCK_LOG2]);
      found.blocks.last_y <= 13'(end_y[13:BLOCK_LOG2]);
      found.end_column <= 3'(end_x[BLOCK_LOG2-1:0]);
      found.end_row <= 3'(end_y[BLOCK_LOG2-1:0]);
      found.destination <= words[167:128];
      found.pitch <= words[215:192];
      found.bitmap <= words[295:256];
    end
  end

  // ---- What has come.
  logic stored;
  assign valid = stored && !stale;
  hmlfc_fifo #(.WIDTH(hmlfc_pkg::DESCRIPTOR_BITS), .DEPTH(AHEAD + 1)) descriptors (
      .clk, .rst_n(rst_n && !forget), .in_valid(checked), .in_ready(), .in_data(found), .out_valid(stored),
      .out_ready(take), .out_data(view), .count()
  );

endmodule

`default_nettype wire
