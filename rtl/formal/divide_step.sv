// Division of any widths, from any state, step by step: of the dividend the upper bits are the first rest; each step the next bit joins the rest, and
// is 1 in the quotient where the divisor fits; it fits once at most.
//
// Clauses: CNV-1
// Engine: bmc 2
// Parts: 2
// Complete: a start and any step in which the rest is below the divisor, as it then stays; proof divide has what comes of all.
// Fault: hmlfc_divide.sv / next >= {1'b0, by} / next > {1'b0, by}
// Fault: hmlfc_divide.sv / done <= left == 1 / done <= left == 2
// Fault: hmlfc_divide.sv / DIVISOR_BITS'(next - {1'b0, by}) / DIVISOR_BITS'(next - by - 1'b1)
module prove_divide_step #(
  parameter integer PART = 0,
  parameter integer WIDTH = PART == 0 ? 22 : 11,
  parameter integer DIVISOR_BITS = 11,
  parameter integer QUOTIENT_BITS = 11
) (input logic clk, input logic rst_n, input logic start, input logic [WIDTH-1:0] dividend, input logic [DIVISOR_BITS-1:0] divisor);
  localparam integer D = DIVISOR_BITS, Q = QUOTIENT_BITS;
  logic         idle, done;
  logic [Q-1:0] quotient;
  hmlfc_divide #(.WIDTH(WIDTH), .DIVISOR_BITS(DIVISOR_BITS), .QUOTIENT_BITS(QUOTIENT_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .start(start), .dividend(dividend), .divisor(divisor), .idle(idle), .done(done), .quotient(quotient));
  (* hierconn *) wire [D-1:0] \dut.rest ;
  (* hierconn *) wire [D-1:0] \dut.by ;
  (* hierconn *) wire [$clog2(Q+1)-1:0] \dut.left ;
  logic         was = 1'b0, was_reset = 1'b0, next_done;
  logic [D:0]   sum;  // the rest that is left, with the divisor where it fitted
  logic [Q-1:0] old;
  logic [D-1:0] next_by;
  logic [$clog2(Q+1)-1:0] next_left;
  logic         begins, steps;
  always @(posedge clk) begin
    was <= rst_n;
    was_reset <= !rst_n;
    {begins, steps} <= {start, !start && !idle};
    sum <= start ? dividend >> Q : {\dut.rest , quotient[Q-1]};
    old <= start ? dividend : quotient;
    next_by <= start ? divisor : \dut.by ;
    next_left <= start ? Q : idle ? 0 : \dut.left - 1'b1;
    next_done <= !start && \dut.left == 1;
  end
  always @* begin
    if (start) assume ((dividend >> Q) < divisor);
    assume (\dut.rest < \dut.by || idle);
    assert (idle == (\dut.left == 0));
    if (was_reset) assert (idle && !done);
    if (was) begin
      assert (done == next_done && \dut.left == next_left && \dut.by == next_by);
      if (begins) assert ({1'b0, \dut.rest } == sum && quotient == old);
      if (steps) assert (quotient[Q-1:1] == old[Q-2:0] && \dut.rest < \dut.by && sum == {1'b0, \dut.rest } + (quotient[0] ? \dut.by : {D{1'b0}}));
      if (!begins && !steps) assert (quotient == old);
    end
  end
endmodule
