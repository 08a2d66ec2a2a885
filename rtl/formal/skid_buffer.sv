// The register slice against a list of at most two words: what comes out is what went in, each word once and in order;
// a word that is offered stays until it is taken; neither valid nor ready waits for the other. WIDTH = 8.
//
// Clauses: Channels (docs/decode_unit.md)
// Engine: induction 2 16
// Complete: the list is bound to the slice's second register, so the induction needs no reachability.
module prove_skid_buffer #(
  parameter integer WIDTH = 8
) (
  input logic clk, input logic rst_n, input logic in_valid, input logic [WIDTH-1:0] in_data, input logic out_ready
);
  logic       in_ready, out_valid;
  logic [WIDTH-1:0] out_data;
  hmlfc_skid_buffer #(.WIDTH(WIDTH)) dut (
    .clk(clk), .rst_n(rst_n), .in_valid(in_valid), .in_ready(in_ready), .in_data(in_data),
    .out_valid(out_valid), .out_ready(out_ready), .out_data(out_data));

  logic       reset_done = 1'b0;
  logic [1:0] held;
  logic [WIDTH-1:0] word_0, word_1;
  wire        put = in_valid && in_ready;
  wire        take = out_valid && out_ready;
  wire  [1:0] rest = held - {1'b0, take};
  always @(posedge clk) begin
    reset_done <= 1'b1;
    held <= rst_n ? rest + {1'b0, put} : 2'd0;
    word_0 <= put && rest == 0 ? in_data : take ? word_1 : word_0;
    word_1 <= put && rest == 1 ? in_data : word_1;
  end

  (* hierconn *) wire [WIDTH-1:0] \dut.skid ;

  logic       waiting;
  logic [WIDTH-1:0] waiting_data;
  always @(posedge clk) begin
    waiting <= rst_n && out_valid && !out_ready;
    waiting_data <= out_data;
  end

  always @* begin
    if (!reset_done) assume (!rst_n);
    if (reset_done) begin
      assert (held <= 2);
      assert (out_valid == (held != 0));
      assert (in_ready == (held != 2));
      if (held != 0) assert (out_data == word_0);
      if (held == 2) assert (\dut.skid == word_1);
    end
  end
  always @(posedge clk) begin
    if (reset_done && waiting && $past(reset_done)) assert (out_valid && out_data == waiting_data);
  end
endmodule
