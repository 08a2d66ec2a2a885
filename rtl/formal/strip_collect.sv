// Collecting strips, from any state, step by step: four samples a clock of a block, those of a block with an error from its status, after the last block
// the strip's first sample again until it has 64; least and greatest of four in two clocks, then of the strip, which leaves whole.
//
// Clauses: Descriptors (docs/view_unit.md)
// Engine: bmc 2
// Complete: any state and one step from it.
// Fault: hmlfc_strip_collect.sv / error <= in_status != 0 / error <= in_status[4:0] != 0
// Fault: hmlfc_strip_collect.sv / s2 < s3 ? s3 : s2 / s2 < s3 ? s2 : s3
// Fault: hmlfc_strip_collect.sv / out_most <= most / out_most <= high_2
// Fault: hmlfc_strip_collect.sv / finishes[1] || finishes[2] || complete / finishes[1] || complete
module prove_strip_collect #(
  parameter integer BLOCK_LOG2 = 1,
  localparam integer B = 16 << (2 * BLOCK_LOG2)
) (
  input logic clk, input logic rst_n, input logic in_valid, input logic [B-1:0] in_samples, input logic [5:0] in_status, input logic in_ends,
  input logic out_ready
);
  logic          in_ready, out_valid, empty;
  logic [1023:0] out_samples;
  logic [15:0]   out_least, out_most;
  hmlfc_strip_collect #(.BLOCK_LOG2(BLOCK_LOG2)) dut (
    .clk(clk), .rst_n(rst_n), .in_valid(in_valid), .in_ready(in_ready), .in_samples(in_samples), .in_status(in_status), .in_ends(in_ends),
    .out_valid(out_valid), .out_ready(out_ready), .out_samples(out_samples), .out_least(out_least), .out_most(out_most), .empty(empty));
  (* hierconn *) wire \dut.held ;
  (* hierconn *) wire \dut.ends ;
  (* hierconn *) wire \dut.error ;
  (* hierconn *) wire \dut.filling ;
  (* hierconn *) wire [5:0] \dut.status ;
  (* hierconn *) wire [B-1:0] \dut.block ;
  (* hierconn *) wire [15:0] \dut.first ;
  (* hierconn *) wire [3:0] \dut.quartet ;
  (* hierconn *) wire [3:0] \dut.place ;
  (* hierconn *) wire [2:1] \dut.valid ;
  (* hierconn *) wire [2:1] \dut.begins ;
  (* hierconn *) wire [2:1] \dut.finishes ;
  (* hierconn *) wire [15:0] \dut.low_0 ;
  (* hierconn *) wire [15:0] \dut.low_1 ;
  (* hierconn *) wire [15:0] \dut.low_2 ;
  (* hierconn *) wire [15:0] \dut.high_0 ;
  (* hierconn *) wire [15:0] \dut.high_1 ;
  (* hierconn *) wire [15:0] \dut.high_2 ;
  (* hierconn *) wire [1023:0] \dut.samples ;
  (* hierconn *) wire \dut.complete ;
  (* hierconn *) wire [15:0] \dut.least ;
  (* hierconn *) wire [15:0] \dut.most ;
  function [15:0] lesser(input signed [15:0] a, input signed [15:0] b);
    lesser = a < b ? a : b;
  endfunction
  function [15:0] greater(input signed [15:0] a, input signed [15:0] b);
    greater = a > b ? a : b;
  endfunction
  // A quartet goes into the strip while none that is whole waits.
  wire        puts = (\dut.held || \dut.filling ) && \dut.finishes == 0 && !\dut.complete ;
  wire        of_strip = \dut.place == 15;
  wire        of_block = \dut.held && \dut.quartet == (1 << (2 * BLOCK_LOG2)) / 4 - 1;
  wire        ready = !\dut.filling && (!\dut.held || (puts && of_block && !(\dut.ends && !of_strip)));
  wire        takes = in_valid && ready;
  wire        leaves = \dut.complete && (!out_valid || out_ready);
  wire [15:0] bad = 16'h8000 + \dut.status ;
  wire [63:0] four = \dut.filling ? {4{\dut.first }} : \dut.error ? {4{bad}} : \dut.block [63:0];

  logic          was = 1'b0, was_reset = 1'b0, n_held, n_ends, n_error, n_filling, n_complete, n_out;
  logic [5:0]    n_status;
  logic [B-1:0]  n_block;
  logic [15:0]   n_first, n_least, n_most, n_low_0, n_low_1, n_low_2, n_high_0, n_high_1, n_high_2, n_out_least, n_out_most;
  logic [3:0]    n_quartet, n_place;
  logic [2:1]    n_valid, n_begins, n_finishes;
  logic [1023:0] n_samples, n_out_samples;
  always @(posedge clk) begin
    was <= rst_n;
    was_reset <= !rst_n;
    {n_block, n_status, n_error, n_ends, n_quartet} <= takes ? {in_samples, in_status, in_status != 6'd0, in_ends, 4'd0} :
      {puts ? \dut.block >> 64 : \dut.block , \dut.status , \dut.error , \dut.ends , \dut.quartet + {3'd0, puts}};
    n_held <= takes || (\dut.held && !(puts && of_block));
    n_filling <= !(puts && of_strip) && (\dut.filling || (puts && of_block && \dut.ends ));
    n_place <= \dut.place + {3'd0, puts};
    n_first <= puts && \dut.place == 0 ? four[15:0] : \dut.first ;
    n_samples <= puts ? {four, \dut.samples [1023:64]} : \dut.samples ;
    n_valid <= {\dut.valid [1], puts};
    n_begins <= {\dut.begins [1], \dut.place == 4'd0};
    n_finishes <= {\dut.finishes [1], puts && of_strip};
    n_complete <= \dut.finishes [2] || (\dut.complete && !leaves);
    {n_low_0, n_low_1} <= {lesser(four[15:0], four[31:16]), lesser(four[47:32], four[63:48])};
    {n_high_0, n_high_1} <= {greater(four[15:0], four[31:16]), greater(four[47:32], four[63:48])};
    {n_low_2, n_high_2} <= {lesser(\dut.low_0 , \dut.low_1 ), greater(\dut.high_0 , \dut.high_1 )};
    n_least <= !\dut.valid [2] ? \dut.least : \dut.begins [2] ? \dut.low_2 : lesser(\dut.least , \dut.low_2 );
    n_most <= !\dut.valid [2] ? \dut.most : \dut.begins [2] ? \dut.high_2 : greater(\dut.most , \dut.high_2 );
    n_out <= \dut.complete || (out_valid && !out_ready);
    {n_out_samples, n_out_least, n_out_most} <= leaves ? {\dut.samples , \dut.least , \dut.most } : {out_samples, out_least, out_most};
  end
  always @* begin
    assert (in_ready == ready);
    assert (empty == (!\dut.held && !\dut.filling && \dut.finishes == 0 && !\dut.complete && \dut.place == 0 && \dut.valid == 0 && !out_valid));
    if (was_reset) assert ({\dut.held , \dut.filling , \dut.place , \dut.valid , \dut.finishes , \dut.complete , out_valid} == 0);
    if (was) begin
      assert ({\dut.block , \dut.status , \dut.error , \dut.ends , \dut.quartet , \dut.held } == {n_block, n_status, n_error, n_ends, n_quartet, n_held});
      assert ({\dut.filling , \dut.place , \dut.first , \dut.samples } == {n_filling, n_place, n_first, n_samples});
      assert ({\dut.valid , \dut.begins , \dut.finishes , \dut.complete } == {n_valid, n_begins, n_finishes, n_complete});
      assert ({\dut.low_0 , \dut.low_1 , \dut.high_0 , \dut.high_1 , \dut.low_2 , \dut.high_2 } == {n_low_0, n_low_1, n_high_0, n_high_1, n_low_2, n_high_2});
      assert ({\dut.least , \dut.most , out_valid, out_samples, out_least, out_most} == {n_least, n_most, n_out, n_out_samples, n_out_least, n_out_most});
    end
  end
endmodule
