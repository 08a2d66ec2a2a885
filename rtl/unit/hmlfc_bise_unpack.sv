// SPDX-License-Identifier: BSD-3-Clause
// The values of a sequence of exactly COUNT values (BISE-1 to BISE-9).
//
// COUNT        4, 16 or 64: the samples of a block
// VALUE_BITS   [4, 14]; the level count of a sequence is at most 2^VALUE_BITS
// WINDOW_BITS  at least COUNT * VALUE_BITS, which the longest sequence takes
//
// level_code   level code of the sequence, [0, 3 * VALUE_BITS - 3]
// window       the sequence from its first bit on; bits after its end do not matter (BISE-7)
// values       value i, in [0, N - 1], at bits VALUE_BITS * i on
//
// Latency 3 clocks with advance, one sequence a clock: the level code is decoded; plain bits and digit
// bits are picked from the window; digits are decoded and joined with them.
`include "hmlfc_tables.svh"
`default_nettype none

module hmlfc_bise_unpack #(
    parameter int COUNT = 16,
    parameter int VALUE_BITS = 10,
    parameter int WINDOW_BITS = 160
) (
    input logic clk,
    input logic advance,
    input logic [5:0] level_code,
    input logic [WINDOW_BITS-1:0] window,
    output logic [COUNT*VALUE_BITS-1:0] values
);
  localparam integer TRITS = HMLFC_TRITS_IN_GROUP;
  localparam integer QUINTS = HMLFC_QUINTS_IN_GROUP;
  localparam integer TRIT_GROUPS = (COUNT + TRITS - 1) / TRITS;
  localparam integer QUINT_GROUPS = (COUNT + QUINTS - 1) / QUINTS;

  // Digit bits before value j of a digit group, at bits 4 * j on (BISE-5, BISE-6).
  localparam [31:0] TRIT_BITS_BEFORE = 32'h75420;
  localparam [31:0] QUINT_BITS_BEFORE = 32'h530;

  localparam integer W = VALUE_BITS;

  // First stage. One bit for each kind of digit and number n of plain bits.
  logic [1:0]             kind;
  logic [3:0]             plain_bits;
  logic [VALUE_BITS:0]    is_plain, is_trit, is_quint;
  logic [WINDOW_BITS-1:0] sequence_bits;

  assign kind = hmlfc_digit_kind(level_code);
  assign plain_bits = hmlfc_plain_bits(level_code);

  always_ff @(posedge clk) begin
    if (advance) begin
      sequence_bits <= window;
      for (int n = 0; n <= VALUE_BITS; n = n + 1) begin
        is_plain[n] <= kind == HMLFC_DIGIT_NONE && plain_bits == n[3:0];
        is_trit[n] <= kind == HMLFC_DIGIT_TRIT && plain_bits == n[3:0];
        is_quint[n] <= kind == HMLFC_DIGIT_QUINT && plain_bits == n[3:0];
      end
    end
  end

  // Zeros above, so that a slice of the greatest width at every start lies inside.
  logic [WINDOW_BITS+2*VALUE_BITS+7:0] padded;
  assign padded = {{(2 * VALUE_BITS + 8) {1'b0}}, sequence_bits};

  // Second stage. Value i: its plain bits, and the three bits behind them, of which the first one,
  // two or three are of its digit group's T or Q.
  logic [COUNT*VALUE_BITS-1:0] plain_next, plain;
  logic [COUNT*3-1:0]          digits_next, digits;
  logic [VALUE_BITS-2:0]       trit_at;   // one bit for each n, with trits
  logic [VALUE_BITS-3:0]       quint_at;  // the same with quints

  genvar i;
  generate
    for (i = 0; i < COUNT; i = i + 1) begin : gen_pick
      localparam integer T_GROUP = i / TRITS;
      localparam integer T_PLACE = i % TRITS;
      localparam integer T_BEFORE = (TRIT_BITS_BEFORE >> (4 * T_PLACE)) & 15;
      localparam integer Q_GROUP = i / QUINTS;
      localparam integer Q_PLACE = i % QUINTS;
      localparam integer Q_BEFORE = (QUINT_BITS_BEFORE >> (4 * Q_PLACE)) & 15;
      // The value's plain bits start at *_FIXED + i * n.
      localparam integer T_FIXED = T_GROUP * HMLFC_TRIT_GROUP_BITS + T_BEFORE;
      localparam integer Q_FIXED = Q_GROUP * HMLFC_QUINT_GROUP_BITS + Q_BEFORE;

      logic [VALUE_BITS-1:0] bits, below;
      logic [2:0]            behind;
      always @* begin
        bits = {VALUE_BITS{1'b0}};
        behind = 3'd0;
        below = {VALUE_BITS{1'b0}};  // 2^n - 1
        for (int n = 0; n <= VALUE_BITS; n = n + 1) begin
          bits = bits | (padded[i * n +: W] & below & {W{is_plain[n]}});
          if (n <= VALUE_BITS - 2) begin
            bits = bits | (padded[T_FIXED + i * n +: W] & below & {W{is_trit[n]}});
            behind = behind | (padded[T_FIXED + (i + 1) * n +: 3] & {3{is_trit[n]}});
          end
          if (n <= VALUE_BITS - 3) begin
            bits = bits | (padded[Q_FIXED + i * n +: W] & below & {W{is_quint[n]}});
            behind = behind | (padded[Q_FIXED + (i + 1) * n +: 3] & {3{is_quint[n]}});
          end
          below = {below[VALUE_BITS-2:0], 1'b1};
        end
      end
      assign plain_next[i*VALUE_BITS +: VALUE_BITS] = bits;
      assign digits_next[i*3 +: 3] = behind;
    end
  endgenerate

  always_ff @(posedge clk) begin
    if (advance) begin
      plain <= plain_next;
      digits <= digits_next;
      trit_at <= is_trit[VALUE_BITS-2:0];
      quint_at <= is_quint[VALUE_BITS-3:0];
    end
  end

  // Third stage. Digit bits of values that the last digit group lacks are 0 (BISE-7).
  localparam integer PLACES =
      TRIT_GROUPS * TRITS > QUINT_GROUPS * QUINTS ? TRIT_GROUPS * TRITS : QUINT_GROUPS * QUINTS;
  logic [PLACES*3-1:0]              digits_padded;
  // Not all bits are used: the last digit group has digits beyond value COUNT - 1.
  logic [TRIT_GROUPS*TRITS*2-1:0]   trits;
  logic [QUINT_GROUPS*QUINTS*3-1:0] quints;
  logic [COUNT*VALUE_BITS-1:0]      values_next;

  assign digits_padded = {{((PLACES - COUNT) * 3) {1'b0}}, digits};

  genvar g;
  generate
    for (g = 0; g < TRIT_GROUPS; g = g + 1) begin : gen_trits
      // Not all bits are used: trits have 2 or 1 of 3 digit bits.
      logic [14:0] d;
      assign d = digits_padded[g*TRITS*3 +: 15];
      hmlfc_trits decode (.code({d[12], d[10:9], d[6], d[4:3], d[1:0]}),
                          .trits(trits[g*TRITS*2 +: TRITS*2]));
    end
    for (g = 0; g < QUINT_GROUPS; g = g + 1) begin : gen_quints
      // Not all bits are used: quints have 3 or 2 of 3 digit bits.
      logic [8:0] d;
      assign d = digits_padded[g*QUINTS*3 +: 9];
      hmlfc_quints decode (.code({d[7:6], d[4:3], d[2:0]}),
                           .quints(quints[g*QUINTS*3 +: QUINTS*3]));
    end
    for (i = 0; i < COUNT; i = i + 1) begin : gen_join
      // The digit stands above the value's n plain bits.
      logic [VALUE_BITS-1:0] above;
      always @* begin
        above = {VALUE_BITS{1'b0}};
        for (int n = 0; n <= VALUE_BITS - 2; n = n + 1) begin
          above[n +: 2] = above[n +: 2] | (trits[i*2 +: 2] & {2{trit_at[n]}});
          if (n <= VALUE_BITS - 3) begin
            above[n +: 3] = above[n +: 3] | (quints[i*3 +: 3] & {3{quint_at[n]}});
          end
        end
      end
      assign values_next[i*VALUE_BITS +: VALUE_BITS] = plain[i*VALUE_BITS +: VALUE_BITS] | above;
    end
  endgenerate

  always_ff @(posedge clk) begin
    if (advance) values <= values_next;
  end
endmodule

`default_nettype wire
