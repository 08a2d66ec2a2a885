// Of a record memory, for each read port and each bank: of a write the bank takes the beat's word that it holds, if there is one; of a read it is asked
// for the one word of the window that it holds. Word n is in bank n modulo BANKS, row n / BANKS; words past the end wrap. What banks give: proof ram;
// where it comes in the window: proof record_ram. DATA_BITS = 64, BANKS = 8, WORDS = 1024, READS = 3.
//
// Clauses: none: tile records (docs/pipeline.md)
// Engine: bmc 1
// Cut: ram
// Complete: the inputs of banks come from inputs of the module in the same clock.
// Fault: hmlfc_record_ram.sv / word[BANK_BITS-1:0] > BANK_BITS'(b) / word[BANK_BITS-1:0] >= BANK_BITS'(b)
// Fault: hmlfc_record_ram.sv / .write_address(written[WORD_BITS-1:BANK_BITS]) / .write_address(row)
// Fault: hmlfc_record_ram.sv / .read(read_enable[r]) / .read(read_enable[0])
module prove_record_ram_banks #(
  parameter integer DATA_BITS = 64,
  parameter integer BANKS = 8,
  parameter integer WORDS = 1024,
  parameter integer READS = 3
) (
  input logic clk, input logic write, input logic [$clog2(WORDS)-$clog2(DATA_BITS/64)-1:0] write_beat, input logic [DATA_BITS-1:0] write_data,
  input logic [READS-1:0] read_enable, input logic [READS*$clog2(WORDS)-1:0] read_word
);
  localparam integer W = $clog2(WORDS);
  localparam integer B = $clog2(BANKS);
  localparam integer LANES = DATA_BITS / 64;  // words of a beat
  logic [READS*BANKS*64-1:0] window;
  hmlfc_record_ram #(.DATA_BITS(DATA_BITS), .BANKS(BANKS), .WORDS(WORDS), .READS(READS)) dut (
    .clk(clk), .write(write), .write_beat(write_beat), .write_data(write_data), .read_enable(read_enable), .read_word(read_word), .window(window));

  // The names of these blocks are those of the module, so the wires in them are its.
  generate
    for (genvar r = 0; r < READS; r = r + 1) begin : \dut.g_read
      wire [W-1:0] begins = read_word[r*W +: W];
      for (genvar b = 0; b < BANKS; b = b + 1) begin : g_bank
        (* hierconn *) wire           \bank.clk ;
        (* hierconn *) wire           \bank.write ;
        (* hierconn *) wire [W-B-1:0] \bank.write_address ;
        (* hierconn *) wire [63:0]    \bank.write_data ;
        (* hierconn *) wire           \bank.read ;
        (* hierconn *) wire [W-B-1:0] \bank.read_address ;
        localparam integer LANE = b % LANES;
        wire [W-1:0] put = write_beat * LANES + LANE;
        wire [B-1:0] behind = b - begins;  // words of the window before the bank's
        wire [W-1:0] got = begins + behind;
        always @* begin
          assert (\bank.write == (write && put[B-1:0] == b));
          if (\bank.write ) assert (\bank.write_address == put[W-1:B] && \bank.write_data == write_data[64*LANE +: 64]);
          assert (\bank.read == read_enable[r] && \bank.clk == clk);
          if (\bank.read ) assert (\bank.read_address == got[W-1:B]);
        end
      end
    end
  endgenerate
endmodule
