// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Packs strips of 64 samples (docs/decode_unit.md, "The reference area"): 4 bits width, 16 bits base, then the samples
// in so many bits less the least; four samples a clock.
//
// A strip comes out as words of 64 bits in order; `out_last` with its last one. A strip with an error, which a sample
// below -2^15 + 32 says, or whose samples take more than 14 bits, has width 15 and its samples as they are.
module hmlfc_strip_pack (
    input logic clk,
    input logic rst_n,

    input logic in_valid,
    output logic in_ready,
    input logic [1023:0] in_samples,
    input logic signed [15:0] in_least,
    input logic signed [15:0] in_most,

    output logic out_valid,
    input logic out_ready,
    output logic [63:0] out_word,
    output logic out_last,
    output logic empty
);

  logic rest;  // what is left of a strip is the next word
  wire advance = !out_valid || out_ready;
  wire shift = advance && !rest;

  // ---- The strip: its width, then its samples.
  typedef enum logic [1:0] {IDLE, WIDTH, SAMPLES} state_t;
  state_t state;
  logic [1023:0] samples;
  logic [15:0] least, span;
  logic poisoned;
  logic [3:0] quartet;
  logic [3:0] width;  // field of the strip
  logic [4:0] bits;   // of a sample
  logic [15:0] base;
  logic [4:0] needed;
  always_comb begin
    needed = '0;
    for (int i = 0; i < 16; i++) if (span[i]) needed = 5'(i + 1);
  end
  wire raw = poisoned || needed > 5'd14;
  wire last = state == SAMPLES && quartet == 4'd15;
  assign in_ready = state == IDLE;
  always_ff @(posedge clk) begin
    if (in_valid && in_ready) begin
      samples <= in_samples;
      least <= in_least;
      span <= in_most - in_least;
      poisoned <= in_least[15:5] == 11'b10000000000;
      quartet <= '0;
    end
    if (state == WIDTH) begin
      width <= raw ? 4'd15 : needed[3:0];
      bits <= raw ? 5'd16 : needed;
      base <= raw ? 16'd0 : least;
    end
    if (state == SAMPLES && shift) begin
      samples <= samples >> 64;
      quartet <= quartet + 4'd1;
    end
    if (!rst_n) state <= IDLE;
    else begin
      unique case (state)
        IDLE: if (in_valid) state <= WIDTH;
        WIDTH: state <= SAMPLES;
        default: if (last && shift) state <= IDLE;
      endcase
    end
  end

  // ---- 1: four samples less the base. A sample has `bits` bits then, and 0 above. 2 and 3: one after the other.
  logic [3:1] valid, begins, ends;
  logic [15:0] value_0, value_1, value_2, value_3;
  logic [31:0] pair_0, pair_1;
  logic [63:0] four;
  logic [4:0] bits_1, bits_2, bits_3;
  logic [19:0] head_1, head_2, head_3;
  always_ff @(posedge clk) begin
    if (shift) begin
      value_0 <= samples[15:0] - base;
      value_1 <= samples[31:16] - base;
      value_2 <= samples[47:32] - base;
      value_3 <= samples[63:48] - base;
      {bits_3, bits_2, bits_1} <= {bits_2, bits_1, bits};
      {head_3, head_2, head_1} <= {head_2, head_1, base, width};
      pair_0 <= 32'(value_0) | 32'(value_1) << bits_1;
      pair_1 <= 32'(value_2) | 32'(value_3) << bits_1;
      four <= 64'(pair_0) | 64'(pair_1) << {bits_2, 1'b0};
      begins <= {begins[2:1], quartet == 4'd0};
      ends <= {ends[2:1], last};
    end
    if (!rst_n) valid <= '0;
    else if (shift) valid <= {valid[2:1], state == SAMPLES};
  end

  // ---- The words. After the last samples what is left is a word of its own.
  logic [127:0] gathered;
  logic [6:0] fill;  // bits in `gathered`
  wire [127:0] held = begins[3] ? 128'(head_3) : gathered;
  wire [6:0] held_fill = begins[3] ? 7'd20 : fill;
  wire [127:0] after = held | 128'(four) << held_fill[5:0];
  wire [7:0] after_fill = {1'b0, held_fill} + {1'b0, bits_3, 2'b00};
  wire whole = after_fill >= 8'd64;
  wire take = valid[3] && shift;
  always_ff @(posedge clk) begin
    if (advance) begin
      if (rest) begin
        out_word <= gathered[63:0];
        out_last <= 1'b1;
      end else begin
        out_word <= after[63:0];
        out_last <= ends[3] && (!whole || after_fill == 8'd64);
      end
    end
    if (take) begin
      gathered <= whole ? after >> 64 : after;
      fill <= whole ? 7'(after_fill - 8'd64) : after_fill[6:0];
    end
    if (!rst_n) begin
      out_valid <= 1'b0;
      rest <= 1'b0;
    end else if (advance) begin
      out_valid <= rest || (valid[3] && (whole || ends[3]));
      rest <= !rest && valid[3] && ends[3] && whole && after_fill != 8'd64;
    end
  end
  assign empty = state == IDLE && valid == 0 && !rest && !out_valid;

endmodule

`default_nettype wire
