// a * b + c, one bit of b a clock.
//
// `start` takes a, b and c when `idle`; `done` is high for one clock when `sum`, modulo 2^SUM_BITS, is valid; it holds until the next start.
// Latency: as many clocks as b has bits up to its highest 1, at least one.
module hmlfc_multiply_add #(
    parameter int A_BITS = 34,
    parameter int B_BITS = 22,
    parameter int SUM_BITS = 44
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input logic [A_BITS-1:0] a,
    input logic [B_BITS-1:0] b,
    input logic [SUM_BITS-1:0] c,
    output logic idle,
    output logic done,
    output logic [SUM_BITS-1:0] sum
);
  logic busy;
  logic [SUM_BITS-1:0] addend;  // a times the weight of the lowest bit in `left`
  logic [B_BITS-1:0] left;

  assign idle = !busy;
  always_ff @(posedge clk) begin
    done <= 1'b0;
    if (start) begin
      addend <= SUM_BITS'(a);
      left <= b;
      sum <= c;
      busy <= 1'b1;
    end else if (busy) begin
      if (left[0]) sum <= sum + addend;
      addend <= addend << 1;
      left <= left >> 1;
      busy <= left[B_BITS-1:1] != 0;
      done <= left[B_BITS-1:1] == 0;
    end
    if (!rst_n) begin
      busy <= 1'b0;
      done <= 1'b0;
    end
  end
endmodule
