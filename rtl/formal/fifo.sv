// The queue against a list of words: what comes out is what went in, each word once and in order; a word that is
// offered stays until it is taken; valid does not wait for ready; `count` is the number of words inside; a word fits if
// and only if it is less than DEPTH. WIDTH = 8, DEPTH = 4.
//
// Clauses: Channels (docs/decode_unit.md)
// Engine: induction 2 16
// Complete: the list is bound to the queue's storage, so the induction needs no reachability.
module prove_fifo (
  input logic clk, input logic rst_n, input logic in_valid, input logic [7:0] in_data, input logic out_ready
);
  logic       in_ready, out_valid;
  logic [7:0] out_data;
  logic [2:0] count;
  hmlfc_fifo #(.WIDTH(8), .DEPTH(4)) dut (
    .clk(clk), .rst_n(rst_n), .in_valid(in_valid), .in_ready(in_ready), .in_data(in_data),
    .out_valid(out_valid), .out_ready(out_ready), .out_data(out_data), .count(count));

  // The list: word 0 is the oldest.
  logic       reset_done = 1'b0;
  logic [2:0] held;
  logic [7:0] word_0, word_1, word_2, word_3;
  wire        put = in_valid && in_ready;
  wire        take = out_valid && out_ready;
  wire  [2:0] rest = held - {2'd0, take};
  always @(posedge clk) begin
    reset_done <= 1'b1;
    held <= rst_n ? rest + {2'd0, put} : 3'd0;
    word_0 <= put && rest == 0 ? in_data : take ? word_1 : word_0;
    word_1 <= put && rest == 1 ? in_data : take ? word_2 : word_1;
    word_2 <= put && rest == 2 ? in_data : take ? word_3 : word_2;
    word_3 <= put && rest == 3 ? in_data : word_3;
  end

  // The same words inside.
  (* hierconn *) wire [7:0] \dut.storage.words[0] ;
  (* hierconn *) wire [7:0] \dut.storage.words[1] ;
  (* hierconn *) wire [7:0] \dut.storage.words[2] ;
  (* hierconn *) wire [7:0] \dut.storage.words[3] ;
  (* hierconn *) wire [2:0] \dut.taken ;
  wire [31:0] storage = {\dut.storage.words[3] , \dut.storage.words[2] , \dut.storage.words[1] ,
      \dut.storage.words[0] };
  wire [63:0] turned = {storage, storage} >> {\dut.taken [1:0], 3'd0};

  logic       waiting;
  logic [7:0] waiting_data;
  always @(posedge clk) begin
    waiting <= rst_n && out_valid && !out_ready;
    waiting_data <= out_data;
  end

  always @* begin
    if (!reset_done) assume (!rst_n);
    if (reset_done) begin
      assert (held <= 4);
      assert (count == held);
      assert (in_ready == (held != 4));
      assert (out_valid == (held != 0));
      if (held > 0) assert (out_data == word_0);
      if (held > 0) assert (turned[7:0] == word_0);
      if (held > 1) assert (turned[15:8] == word_1);
      if (held > 2) assert (turned[23:16] == word_2);
      if (held > 3) assert (turned[31:24] == word_3);
    end
  end
  always @(posedge clk) begin
    if (reset_done && waiting && $past(reset_done)) assert (out_valid && out_data == waiting_data);
  end
endmodule
