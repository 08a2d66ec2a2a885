// A window that was read has, of any word that was written before, what was written to it last, at the word's distance from where the window begins,
// past the end those of the begin; it is there in the next clock and stays until the next read of its port. Of a word that is written in the clock of
// the read nothing is said. Any bit of any word, any order of writes and of reads on all ports. 16 words, 4 banks, beats of 128 bits, 3 ports.
//
// Clauses: none: records in memory (docs/pipeline.md)
// Engine: bmc 4
// Parts: 3
// Memories: arrays
// Complete: what a word holds and what was read last are all the state there is.
// Fault: hmlfc_record_ram.sv / word[BANK_BITS-1:0] > BANK_BITS'(b) / word[BANK_BITS-1:0] >= BANK_BITS'(b)
// Fault: hmlfc_record_ram.sv / if (read_enable[r]) first <= / first <=
// Fault: hmlfc_record_ram.sv / LANE = b & (BEAT_WORDS - 1) / LANE = 0
// Fault: hmlfc_record_ram.sv / written[BANK_BITS-1:0] == BANK_BITS'(b) / written[0] == 1'(b)
module prove_record_ram #(
  parameter integer DATA_BITS = 128,
  parameter integer BANKS = 4,
  parameter integer WORDS = 16,
  parameter integer READS = 3,
  parameter integer PART = 0  // the port
) (
  input logic clk, input logic write, input logic [$clog2(WORDS/(DATA_BITS/64))-1:0] write_beat, input logic [DATA_BITS-1:0] write_data,
  input logic [READS-1:0] read_enable, input logic [READS*$clog2(WORDS)-1:0] read_word
);
  localparam integer W = $clog2(WORDS);
  localparam integer LANES = DATA_BITS / 64;
  logic [READS*BANKS*64-1:0] window;
  hmlfc_record_ram #(.DATA_BITS(DATA_BITS), .BANKS(BANKS), .WORDS(WORDS), .READS(READS)) dut (
    .clk(clk), .write(write), .write_beat(write_beat), .write_data(write_data), .read_enable(read_enable), .read_word(read_word), .window(window));

  // The word that is watched, and its bit.
  (* anyconst *) logic [W-1:0] watched;
  (* anyconst *) logic [5:0] place;
  logic        is_written = 1'b0;
  logic        content;
  wire         now = write && write_beat == watched / LANES;
  wire [DATA_BITS-1:0] lane = write_data >> (64 * (watched % LANES));
  always @(posedge clk) if (now) {is_written, content} <= {1'b1, lane[place]};

  // Its distance from where the window of the port's last read begins; whether it is known and within the window.
  logic         is_read = 1'b0;
  logic [W-1:0] at;
  logic         expected;
  wire [W-1:0]  distance = watched - read_word[PART % READS * W +: W];
  wire [63:0]   found = window >> (64 * (PART % READS * BANKS + at));
  always @(posedge clk) if (read_enable[PART % READS]) {is_read, at, expected} <= {is_written && !now && distance < BANKS, distance, content};
  always @* if (is_read) assert (found[place] == expected);
endmodule
