// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Memory of tile records: written in beats, read as windows of BANKS words of 64 bits that begin at
// any word.
//
// READS ports read at the same time, each from a copy of its own. With `read_enable` of a port the
// window of its `read_word` is at its `window` in the next clock and stays until the next read;
// word read_word + i is at bits 64i+63:64i. Words past the end wrap.
module hmlfc_record_ram #(
    parameter int DATA_BITS = 128,
    parameter int BANKS = 4,  // a power of two, at least DATA_BITS / 64
    parameter int WORDS = 2048,  // a power of two
    parameter int READS = 2,
    localparam int WORD_BITS = $clog2(WORDS),
    localparam int BEAT_BITS = WORD_BITS - $clog2(DATA_BITS / 64)
) (
    input logic clk,

    input logic write,
    input logic [BEAT_BITS-1:0] write_beat,
    input logic [DATA_BITS-1:0] write_data,

    input logic [READS-1:0] read_enable,
    input logic [READS*WORD_BITS-1:0] read_word,
    output logic [READS*BANKS*64-1:0] window
);

  localparam int ROWS = WORDS / BANKS;
  localparam int ROW_BITS = $clog2(ROWS);
  localparam int BANK_BITS = $clog2(BANKS);
  localparam int BEAT_WORDS = DATA_BITS / 64;

  for (genvar r = 0; r < READS; r++) begin : g_read
    wire [WORD_BITS-1:0] word = read_word[r*WORD_BITS+:WORD_BITS];
    logic [BANK_BITS-1:0] first;
    logic [BANKS*64-1:0] rows;  // what each bank gave

    always_ff @(posedge clk) if (read_enable[r]) first <= word[BANK_BITS-1:0];

    for (genvar b = 0; b < BANKS; b++) begin : g_bank
      // The bank's first word at or after `word`.
      /* verilator lint_off CMPCONST */  // never for the last bank
      wire [ROW_BITS-1:0] row = word[WORD_BITS-1:BANK_BITS] + ROW_BITS'(word[BANK_BITS-1:0] > BANK_BITS'(b));
      /* verilator lint_on CMPCONST */
      localparam int LANE = b & (BEAT_WORDS - 1);  // of the bank's word in a beat
      wire [WORD_BITS-1:0] written = {write_beat, {$clog2(BEAT_WORDS){1'b0}}} + WORD_BITS'(LANE);
      hmlfc_ram #(.WIDTH(64), .DEPTH(ROWS)) bank (
          .clk, .write(write && written[BANK_BITS-1:0] == BANK_BITS'(b)),
          .write_address(written[WORD_BITS-1:BANK_BITS]), .write_data(write_data[LANE*64+:64]), .read(read_enable[r]),
          .read_address(row), .read_data(rows[b*64+:64])
      );
    end

    always_comb begin
      for (int i = 0; i < BANKS; i++) begin
        window[(r*BANKS+i)*64+:64] = rows[32'(BANK_BITS'(first+BANK_BITS'(i)))*64+:64];
      end
    end
  end

endmodule

`default_nettype wire
