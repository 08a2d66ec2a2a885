// Of a queue of any width and depth, the first runs from reset: the word that is watched comes out behind as many words as were in front of it, once,
// and waits unchanged; the count is that of the words inside. All runs of a queue of 4 words: fifo.sv. WIDTH = 8, DEPTH = 8.
//
// Clauses: Channels (docs/decode_unit.md)
// Engine: bmc 7
// Memories: arrays
// Complete: for runs of that many clocks.
// Fault: hmlfc_fifo.sv / put && written == taken_next / 1'b0
// Fault: hmlfc_fifo.sv / is_latest ? latest : stored / stored
// Fault: hmlfc_fifo.sv / .read_address(taken_next[ / .read_address(taken[
module prove_fifo_order #(
  parameter integer WIDTH = 8,
  parameter integer DEPTH = 8
) (
  input logic clk, input logic rst_n, input logic in_valid, input logic [WIDTH-1:0] in_data, input logic out_ready
);
  logic       in_ready, out_valid;
  logic [WIDTH-1:0] out_data;
  logic [$clog2(DEPTH):0] count;
  hmlfc_fifo #(.WIDTH(WIDTH), .DEPTH(DEPTH)) dut (
    .clk(clk), .rst_n(rst_n), .in_valid(in_valid), .in_ready(in_ready), .in_data(in_data), .out_valid(out_valid), .out_ready(out_ready),
    .out_data(out_data), .count(count));

  // The word with this number since reset.
  (* anyconst *) logic [2:0] number;
  logic             started = 1'b0;
  logic [2:0]       puts, takes;
  logic             is_known;
  logic [WIDTH-1:0] word;
  always @(posedge clk) begin
    started <= 1'b1;
    puts <= rst_n ? puts + {2'd0, in_valid && in_ready} : 3'd0;
    takes <= rst_n ? takes + {2'd0, out_valid && out_ready} : 3'd0;
    if (!rst_n) is_known <= 1'b0;
    else if (in_valid && in_ready && puts == number) {is_known, word} <= {1'b1, in_data};
  end
  wire [2:0] inside = puts - takes;
  always @* begin
    assume (rst_n == started);
    if (started) begin
      assert (count == inside && out_valid == (inside != 0) && in_ready == (inside != DEPTH));
      if (is_known && takes == number) assert (out_data == word);
    end
  end
endmodule
