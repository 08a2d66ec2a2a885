// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Packs strips of 64 samples (docs/decode_unit.md, "The reference area"): width and base of each quarter, then the
// samples, four a clock.
//
// A strip comes out as words of 64 bits in order; `out_last` with its last one. A quarter with a sample below -2^14,
// which says that its block is an error, has width 15. Samples are read from hmlfc_strip_collect.
module hmlfc_strip_pack (
    input logic clk,
    input logic rst_n,

    input logic in_valid,
    output logic in_ready,
    input logic [4*16-1:0] in_least,
    input logic [4*16-1:0] in_most,
    input logic [15:0] in_errors,
    output logic read,
    output logic [3:0] read_quartet,
    input logic [63:0] samples,
    output logic read_ends,

    output logic out_valid,
    input logic out_ready,
    output logic [63:0] out_word,
    output logic out_last,
    output logic empty
);

  logic rest;  // what is left of a strip is the next word
  wire advance = !out_valid || out_ready;
  wire shift = advance && !rest;

  // ---- The strip: its four widths, one a clock, then its head, then its samples.
  typedef enum logic [1:0] {IDLE, WIDTHS, HEAD, SAMPLES} state_t;
  state_t state;
  logic [63:0] least, most;
  logic [15:0] errors;
  logic [79:0] heads;
  logic [5:0] widths;  // their sum: a strip has 80 bits and 16 for each
  logic [3:0] quartet;
  logic [1:0] quarter;  // whose width is found
  wire [13:0] span = most[13:0] - least[13:0];
  wire poisoned = least[15:14] == 2'b10;
  logic [3:0] needed;
  always_comb begin
    needed = '0;
    for (int i = 0; i < 14; i++) if (span[i]) needed = 4'(i + 1);
  end
  wire last = state == SAMPLES && quartet == 4'd15;
  assign in_ready = state == IDLE;
  assign read = shift && (state == HEAD || (state == SAMPLES && !last));
  assign read_quartet = state == HEAD ? 4'd0 : quartet + 4'd1;
  assign read_ends = shift && last;
  always_ff @(posedge clk) begin
    if (in_valid && in_ready) begin
      {errors, least, most} <= {in_errors, in_least, in_most};
      {quartet, quarter, widths} <= '0;
    end
    if (state == WIDTHS) begin
      heads <= {poisoned ? {12'd0, errors[3:0]} : least[15:0], poisoned ? 4'd15 : needed, heads[79:20]};
      widths <= widths + (poisoned ? 6'd14 : {2'd0, needed});
      least <= least >> 16;
      most <= most >> 16;
      errors <= errors >> 4;
      quarter <= quarter + 2'd1;
    end
    if (state == SAMPLES && shift) begin
      quartet <= quartet + 4'd1;
      if (quartet[1:0] == 2'd3) heads <= heads >> 20;
    end
    if (!rst_n) state <= IDLE;
    else begin
      unique case (state)
        IDLE: if (in_valid) state <= WIDTHS;
        WIDTHS: if (quarter == 2'd3) state <= HEAD;
        HEAD: if (shift) state <= SAMPLES;
        default: if (last && shift) state <= IDLE;
      endcase
    end
  end
  wire raw = heads[3:0] == 4'd15;
  wire [15:0] base = raw ? 16'd0 : heads[19:4];
  wire [3:0] bits = raw ? 4'd14 : heads[3:0];  // of a sample

  // ---- 1: four samples less the base. A sample has `bits` bits then, and 0 above. 2 and 3: one after the other. The
  // head goes before them.
  logic [3:1] valid, begins, ends;
  logic [15:0] value_0, value_1, value_2, value_3;
  logic [31:0] pair_0, pair_1;
  logic [63:0] four;
  logic [3:0] bits_1, bits_2, bits_3;
  logic [79:0] head;
  logic [4:0] total;  // words of the strip
  wire [15:0] kept = {{2{!raw}}, 14'h3FFF};
  always_ff @(posedge clk) begin
    if (shift) begin
      value_0 <= (samples[15:0] - base) & kept;
      value_1 <= (samples[31:16] - base) & kept;
      value_2 <= (samples[47:32] - base) & kept;
      value_3 <= (samples[63:48] - base) & kept;
      {bits_3, bits_2, bits_1} <= {bits_2, bits_1, bits};
      pair_0 <= 32'(value_0) | 32'(value_1) << bits_1;
      pair_1 <= 32'(value_2) | 32'(value_3) << bits_1;
      four <= 64'(pair_0) | 64'(pair_1) << {bits_2, 1'b0};
      begins <= {begins[2:1], state == HEAD};
      ends <= {ends[2:1], last};
      if (state == HEAD) {head, total} <= {heads, 5'((7'(widths) + 7'd8) >> 2)};
    end
    if (!rst_n) valid <= '0;
    else if (shift) valid <= {valid[2:1], state == HEAD || state == SAMPLES};
  end

  // ---- The words. After the last samples what is left is a word of its own; where nothing is, because samples of no
  // bits end the strip, the word before was the last.
  logic [127:0] gathered;
  logic [6:0] fill;  // bits in `gathered`
  wire [127:0] after = begins[3] ? 128'(head) : gathered | 128'(four) << fill[5:0];
  wire [7:0] after_fill = begins[3] ? 8'd80 : {1'b0, fill} + {2'd0, bits_3, 2'b00};
  wire whole = after_fill >= 8'd64;
  wire take = valid[3] && shift;
  wire emits = rest || (valid[3] && (whole || (ends[3] && after_fill != 8'd0)));
  logic [4:0] words;  // that come after the one in out_word
  wire [4:0] words_now = !rest && begins[3] ? total : words;
  always_ff @(posedge clk) begin
    if (advance) begin
      out_word <= rest ? gathered[63:0] : after[63:0];
      out_last <= words_now == 5'd1;
      if (emits) words <= words_now - 5'd1;
    end
    if (take) begin
      gathered <= whole ? after >> 64 : after;
      fill <= whole ? 7'(after_fill - 8'd64) : after_fill[6:0];
    end
    if (!rst_n) begin
      out_valid <= 1'b0;
      rest <= 1'b0;
    end else if (advance) begin
      out_valid <= emits;
      rest <= !rest && valid[3] && ends[3] && whole && after_fill != 8'd64;
    end
  end
  assign empty = state == IDLE && valid == 0 && !rest && !out_valid;

endmodule

`default_nettype wire
