// Division: `done` comes QUOTIENT_BITS / STEP clocks after `start`, for one clock, and the quotient q satisfies q * divisor <=
// dividend < (q + 1) * divisor; for all dividends and divisors whose quotient fits. With 8 bits throughout, and with 8,
// 5 and 6 bits of dividend, divisor and quotient, two of it a clock; the unit's dividers differ in nothing but widths.
//
// Clauses: CNV-1
// Engine: bmc 11
// Complete for one division from idle; a start interrupts nothing, as it comes when idle.
module prove_divide (
  input logic clk, input logic [7:0] dividend, input logic [7:0] divisor, input logic [7:0] other_dividend,
      input logic [4:0] other_divisor
);
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
  logic       other_idle, other_done;
  logic [5:0] other_quotient;
  logic [7:0] m;
  logic [4:0] e;
  always @(posedge clk) if (start) {m, e} <= {other_dividend, other_divisor};
  hmlfc_divide #(.WIDTH(8), .DIVISOR_BITS(5), .QUOTIENT_BITS(6), .STEP(2)) other (
    .clk(clk), .rst_n(clocks != 0), .start(start), .dividend(other_dividend), .divisor(other_divisor),
    .idle(other_idle), .done(other_done), .quotient(other_quotient));
  wire [10:0] other_below = {5'd0, other_quotient} * {6'd0, e};
  wire [16:0] below = {9'd0, quotient} * {9'd0, d};
  always @* begin
    if (start) assume (divisor != 0 && other_divisor != 0 && {3'd0, other_dividend} < {other_divisor, 6'd0});
    if (clocks == 1) assert (idle);
    if (clocks > 1) assert (done == (clocks == 10));
    if (clocks == 10) assert (idle && below <= {9'd0, n} && {9'd0, n} < below + {9'd0, d});
    if (clocks > 1) assert (other_done == (clocks == 5));
    if (clocks == 5) assert (other_idle && other_below <= {3'd0, m} && {3'd0, m} < other_below + {6'd0, e});
  end
endmodule
