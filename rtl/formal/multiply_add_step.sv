// Multiplication and addition of any widths: a start takes a, b and c; each step adds the multiplicand, times the lowest bit of what is left of b, to
// the sum, whose high half follows a clock later, and shifts both; the end comes when nothing is left, and the sum holds all by then.
// From any state that a multiplication comes to. A_BITS = 34, B_BITS = 22, SUM_BITS = 44.
//
// Clauses: CNV-1
// Engine: bmc 2
// Complete: a start and any step; their sum is a * b + c.
// Fault: hmlfc_multiply_add.sv / high_addend + HIGH'(carry) / high_addend
// Fault: hmlfc_multiply_add.sv / done <= left == 0 / done <= left[B_BITS-2:0] == 0
// Fault: hmlfc_multiply_add.sv / addend << 1 / {addend[SUM_BITS-1], addend[SUM_BITS-3:0], 1'b0}
module prove_multiply_add_step #(
  parameter integer A_BITS = 34,
  parameter integer B_BITS = 22,
  parameter integer SUM_BITS = 44
) (input logic clk, input logic start, input logic [A_BITS-1:0] a, input logic [B_BITS-1:0] b, input logic [SUM_BITS-1:0] c);
  localparam integer LOW = SUM_BITS / 2;
  localparam integer HIGH = SUM_BITS - LOW;
  logic                idle, done;
  logic [SUM_BITS-1:0] sum;
  hmlfc_multiply_add #(.A_BITS(A_BITS), .B_BITS(B_BITS), .SUM_BITS(SUM_BITS)) dut (
    .clk(clk), .rst_n(1'b1), .start(start), .a(a), .b(b), .c(c), .idle(idle), .done(done), .sum(sum));
  (* hierconn *) wire \dut.carry ;
  (* hierconn *) wire [SUM_BITS-1:0] \dut.addend ;
  (* hierconn *) wire [HIGH-1:0] \dut.high_addend ;
  (* hierconn *) wire [B_BITS-1:0] \dut.left ;

  // After `steps` steps so many low bits of the multiplicand are 0, and so many high ones of what is left.
  (* anyconst *) logic [4:0] steps;
  wire [SUM_BITS-1:0] held = sum + ({\dut.high_addend , LOW'(0)} + {{(HIGH-1){1'b0}}, \dut.carry , LOW'(0)});
  wire [HIGH-2:0]     late = \dut.high_addend [HIGH-2:0];
  logic                was = 1'b0;
  logic                was_start, was_idle, was_end;
  logic [SUM_BITS-1:0] next_held, next_addend;
  logic [B_BITS-1:0]   next_left;
  always @(posedge clk) begin
    was <= 1'b1;
    {was_start, was_idle, was_end} <= {start, idle, \dut.left == 0};
    next_held <= start ? c : held + (\dut.left [0] ? \dut.addend : SUM_BITS'(0));
    next_addend <= start ? SUM_BITS'(a) : SUM_BITS'({\dut.addend , 1'b0});
    next_left <= start ? b : \dut.left / 2;
  end
  always @* begin
    if (start) assume (idle);
    if (!was && !idle) begin
      assume (steps <= B_BITS && (\dut.addend & ((SUM_BITS'(1) << steps) - 1)) == 0 && (\dut.left >> (B_BITS - steps)) == 0);
      assume (late == 0 || (steps != 0 && late == \dut.addend [SUM_BITS-1:LOW+1]));
      if (steps == 0) assume (\dut.high_addend == 0 && !\dut.carry );
    end
    if (was) begin
      assert (done == (!was_idle && was_end && !was_start) && idle == (!was_start && (was_idle || was_end)));
      if (!idle) assert (held == next_held && \dut.addend == next_addend && \dut.left == next_left);
      if (done) assert (sum == next_held);
    end
  end
endmodule
