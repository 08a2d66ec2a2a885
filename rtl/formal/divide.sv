// Division: `done` comes WIDTH clocks after `start`, for one clock, and the quotient q satisfies q * divisor <= dividend <
// (q + 1) * divisor; for all dividends and divisors. WIDTH = 8; the unit's dividers differ in nothing but WIDTH.
//
// Clauses: CNV-1
// Engine: bmc 11
// Complete for one division from idle; a start interrupts nothing, as it comes when idle.
// Fault: hmlfc_divide.sv / next >= {1'b0, by} / next > {1'b0, by}
module prove_divide (input logic clk, input logic [7:0] dividend, input logic [7:0] divisor);
  logic       idle, done;
  logic [7:0] quotient;
  logic [3:0] clocks = 4'd0;
  wire        start = clocks == 1;
  logic [7:0] n, d;
  always @(posedge clk) begin
    clocks <= clocks + 4'd1;
    if (start) {n, d} <= {dividend, divisor};
  end
  hmlfc_divide #(.WIDTH(8)) dut (
    .clk(clk), .rst_n(clocks != 0), .start(start), .dividend(dividend), .divisor(divisor),
    .idle(idle), .done(done), .quotient(quotient));
  wire [16:0] below = {9'd0, quotient} * {9'd0, d};
  always @* begin
    if (start) assume (divisor != 0);
    if (clocks == 1) assert (idle);
    if (clocks > 1) assert (done == (clocks == 10));
    if (clocks == 10) assert (idle && below <= {9'd0, n} && {9'd0, n} < below + {9'd0, d});
  end
endmodule
