// Multiplication and addition: `done` comes for one clock, at most B_BITS + 2 clocks after `start`, and the sum is a *
// b + c modulo 2^SUM_BITS; for all a, b and c. Widths 5, 4 and 8; the unit's multiplier differs in nothing but widths.
//
// Clauses: CNV-1
// Engine: bmc 9
// Complete for one multiplication from idle; a start interrupts nothing, as it comes when idle.
module prove_multiply_add (input logic clk, input logic [4:0] a, input logic [3:0] b, input logic [7:0] c);
  logic       idle, done;
  logic [7:0] sum;
  logic [3:0] clocks = 4'd0;
  logic       ended = 1'b0;
  wire        start = clocks == 1;
  logic [7:0] expected;
  always @(posedge clk) begin
    clocks <= clocks + 4'd1;
    if (start) expected <= {3'd0, a} * {4'd0, b} + c;
    if (clocks > 1 && done) ended <= 1'b1;
  end
  hmlfc_multiply_add #(.A_BITS(5), .B_BITS(4), .SUM_BITS(8)) dut (
    .clk(clk), .rst_n(clocks != 0), .start(start), .a(a), .b(b), .c(c), .idle(idle), .done(done), .sum(sum));
  always @* begin
    if (clocks == 1) assert (idle && !done);
    if (clocks > 1) assert (!(done && ended) && idle == (done || ended));
    if (clocks > 1 && (done || ended)) assert (sum == expected);
    if (clocks == 7) assert (done || ended);
  end
endmodule
