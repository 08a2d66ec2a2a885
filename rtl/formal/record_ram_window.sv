// Of a record memory, for each read port: word i of the window that begins at word n is what bank (n + i) modulo BANKS gives, and which bank that is
// stays until the next read, whatever other ports do. Banks may give anything. What they are asked for: proof record_ram_banks. DATA_BITS = 64,
// BANKS = 8, WORDS = 1024, READS = 3.
//
// Clauses: none: tile records (docs/pipeline.md)
// Engine: bmc 3
// Parts: 8
// Cut: ram
// Complete: where the last window of a port begins is all the state there is, but the banks.
// Fault: hmlfc_record_ram.sv / BANK_BITS'(first+BANK_BITS'(i)) / BANK_BITS'(first-BANK_BITS'(i))
// Fault: hmlfc_record_ram.sv / if (read_enable[r]) first / first
// Fault: hmlfc_record_ram.sv / if (read_enable[r]) first / if (read_enable[0]) first
// Fault: hmlfc_record_ram.sv / .read_data(rows[b*64+:64]) / .read_data(rows[(BANKS-1-b)*64+:64])
`include "inside.svh"
module prove_record_ram_window #(
  parameter integer DATA_BITS = 64,
  parameter integer BANKS = 8,
  parameter integer WORDS = 1024,
  parameter integer READS = 3,
  parameter integer PART = 0
) (
  input logic clk, input logic [READS-1:0] enable, input logic [READS*$clog2(WORDS)-1:0] word
);
  localparam integer W = $clog2(WORDS);
  localparam integer B = $clog2(BANKS);
  // In the first clock all ports read, port 0 from a word of bank PART on, each other one from a bank more; in the second clock any ports read any words.
  logic [1:0] clocks = 2'd0;
  always @(posedge clk) clocks <= clocks + 2'd1;
  logic [READS*W-1:0] read_word;
  always @* begin
    read_word = word;
    for (integer r = 0; r < READS; r = r + 1) if (clocks == 0) read_word[r*W +: B] = PART + r;
  end
  wire [READS-1:0]           read_enable = clocks == 0 ? {READS{1'b1}} : enable;
  logic [READS*BANKS*64-1:0] window;
  hmlfc_record_ram #(.DATA_BITS(DATA_BITS), .BANKS(BANKS), .WORDS(WORDS), .READS(READS)) dut (
    .clk(clk), .write(1'b0), .write_beat('0), .write_data('0), .read_enable(read_enable), .read_word(read_word), .window(window));

  logic [READS-1:0] reads;  // in the clock before
  always @(posedge clk) reads <= enable;

  // The names of these blocks are those of the module, so the wires in them are its.
  generate
    for (genvar r = 0; r < READS; r = r + 1) begin : \dut.g_read
      `SEEN(B, first)  // the bank of the window's first word
      wire [B-1:0] begins = PART + r;
      always @* if (clocks == 1 || (clocks == 2 && !reads[r])) assert (first == begins);
      for (genvar b = 0; b < BANKS; b = b + 1) begin : g_bank
        `SEEN(64, \bank.read_data )
        localparam integer I = (b + 64 * BANKS - PART - r) % BANKS;  // of the bank's word in the window
        always @* if (clocks == 1) assert (window[(r*BANKS+I)*64 +: 64] == \bank.read_data );
      end
    end
  endgenerate
endmodule
