// Of any read port: each word of its window is the one that was written last at its place, words past the end wrap; the
// window comes in the next clock and stays until the next read. Of a word that is written in the clock in which it is
// read nothing is said. A write, another one, and a read that stays, with any clocks between. DATA_BITS = 64, BANKS =
// 2, WORDS = 16, READS = 2.
//
// Clauses: none: tile records (docs/pipeline.md)
// Engine: bmc 5
// Memories: arrays
// Complete: what a word holds and what a port read last are all the state there is.
module prove_record_ram #(
  parameter integer DATA_BITS = 64,
  parameter integer BANKS = 2,
  parameter integer WORDS = 16,
  parameter integer READS = 2
) (
  input logic clk, input logic [$clog2(WORDS)-$clog2(DATA_BITS/64)-1:0] other_beat,
      input logic [DATA_BITS-1:0] write_data,
  input logic [READS*$clog2(WORDS)-1:0] read_word
);
  localparam integer WORD_BITS = $clog2(WORDS);
  localparam integer BEAT_BITS = WORD_BITS - $clog2(DATA_BITS / 64);
  // The word that is watched: written in the first clock; in the second another beat is; in the third all ports read.
  (* anyconst *) logic [WORD_BITS-1:0] place;
  logic [2:0] clocks = 3'd0;
  always @(posedge clk) clocks <= clocks + 3'd1;
  wire [BEAT_BITS-1:0] beat = place >> $clog2(DATA_BITS / 64);
  logic [READS*BANKS*64-1:0] window;
  hmlfc_record_ram #(.DATA_BITS(DATA_BITS), .BANKS(BANKS), .WORDS(WORDS), .READS(READS)) dut (
    .clk(clk), .write(clocks < 2 && (clocks == 0 || other_beat != beat)), .write_beat(clocks == 0 ? beat : other_beat),
    .write_data(write_data), .read_enable({READS{clocks == 2}}), .read_word(read_word), .window(window));

  logic [63:0]            word;
  logic [READS*BANKS-1:0] is_here;
  always @(posedge clk) begin
    for (integer lane = 0; lane < DATA_BITS / 64; lane = lane + 1)
      if (clocks == 0 && place % (DATA_BITS / 64) == lane) word <= write_data[64*lane +: 64];
    for (integer r = 0; r < READS; r = r + 1)
      for (integer i = 0; i < BANKS; i = i + 1)
        if (clocks == 2) is_here[r*BANKS+i] <= WORD_BITS'(read_word[r*WORD_BITS +: WORD_BITS] + WORD_BITS'(i)) == place;
  end
  always @* if (clocks > 2) begin
    for (integer r = 0; r < READS; r = r + 1)
      for (integer i = 0; i < BANKS; i = i + 1) if (is_here[r*BANKS+i]) assert (window[(r*BANKS+i)*64 +: 64] == word);
  end
endmodule
