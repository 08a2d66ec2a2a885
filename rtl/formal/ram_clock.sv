// Words are written at the clock of the memory: a word, as a register, has what was written in the clock before, any
// other one what it had, from any state. Of a memory of at most 16 words; solvers see no clock of an array. WIDTH = 8,
// DEPTH = 16.
//
// Clauses: Taking it into your chip (docs/decode_unit.md)
// Engine: bmc 4
// Complete: the words are all the state there is, but what was read last: proof ram.
module prove_ram_clock #(
  parameter integer WIDTH = 8,
  parameter integer DEPTH = 16
) (
  input logic clk, input logic write, input logic [$clog2(DEPTH)-1:0] write_address, input logic [WIDTH-1:0] write_data
);
  generate if (DEPTH <= 16) begin
    // In the first clock the word is read, in the second it is again, after a write at any place.
    (* anyconst *) logic [$clog2(DEPTH)-1:0] place;
    logic [WIDTH-1:0] read_data;
    logic [1:0]       clocks = 2'd0;
    hmlfc_ram #(.WIDTH(WIDTH), .DEPTH(DEPTH)) dut (
      .clk(clk), .write(write && clocks == 1), .write_address(write_address), .write_data(write_data), .read(clocks !=
      1), .read_address(place), .read_data(read_data));
    logic [WIDTH-1:0] word;
    always @(posedge clk) begin
      clocks <= clocks + 2'd1;
      if (clocks == 1) word <= write && write_address == place ? write_data : read_data;
    end
    always @* if (clocks == 3) assert (read_data == word);
  end endgenerate
endmodule
