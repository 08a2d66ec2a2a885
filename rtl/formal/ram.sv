// A read gives the word that was written last at its address, in the next clock, and it stays until the next read; of a
// word that is written in the same clock nothing is said. Any word, any order of reads and writes. WIDTH = 8, DEPTH =
// 16.
//
// Clauses: Taking it into your chip (docs/decode_unit.md)
// Engine: bmc 6
// Memories: arrays
// Complete: what a word holds and what was read last are all the state there is.
module prove_ram #(
  parameter integer WIDTH = 8,
  parameter integer DEPTH = 16
) (
  input logic clk, input logic write, input logic [$clog2(DEPTH)-1:0] write_address,
      input logic [WIDTH-1:0] write_data, input logic read,
  input logic [$clog2(DEPTH)-1:0] read_address
);
  logic [WIDTH-1:0] read_data;
  hmlfc_ram #(.WIDTH(WIDTH), .DEPTH(DEPTH)) dut (
    .clk(clk), .write(write), .write_address(write_address), .write_data(write_data), .read(read),
    .read_address(read_address), .read_data(read_data));

  // The word that is watched, and whether it was read last.
  (* anyconst *) logic [$clog2(DEPTH)-1:0] place;
  logic             is_written = 1'b0;
  logic             was_read = 1'b0;
  logic [WIDTH-1:0] word, expected;
  always @(posedge clk) begin
    if (write && write_address == place) {is_written, word} <= {1'b1, write_data};
    if (read) begin
      was_read <= is_written && read_address == place && !(write && write_address == place);
      expected <= word;
    end
  end
  always @* if (was_read) assert (read_data == expected);

  // What it was, read or not.
  logic             stays = 1'b0;
  logic [WIDTH-1:0] before;
  always @(posedge clk) {stays, before} <= {!read, read_data};
  always @* if (stays) assert (read_data == before);
endmodule
