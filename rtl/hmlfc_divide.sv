// Unsigned division, one bit of the quotient a clock.
//
// `start` takes dividend and divisor (at least 1) when `idle`; `done` is high for one clock, WIDTH clocks later, when
// `quotient`, the floor, is valid; it holds until the next start.
module hmlfc_divide #(
    parameter int WIDTH = 22
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input logic [WIDTH-1:0] dividend,
    input logic [WIDTH-1:0] divisor,
    output logic idle,
    output logic done,
    output logic [WIDTH-1:0] quotient
);
  logic [WIDTH-1:0] rest, by;
  logic [$clog2(WIDTH+1)-1:0] left;
  // The rest with the next bit of the dividend; the quotient grows where that was.
  wire [WIDTH:0] next = {rest, quotient[WIDTH-1]};
  wire fits = next >= {1'b0, by};

  assign idle = left == 0;
  always_ff @(posedge clk) begin
    done <= 1'b0;
    if (start) begin
      rest <= '0;
      quotient <= dividend;
      by <= divisor;
      left <= ($clog2(WIDTH + 1))'(WIDTH);
    end else if (left != 0) begin
      rest <= fits ? WIDTH'(next - {1'b0, by}) : next[WIDTH-1:0];
      quotient <= {quotient[WIDTH-2:0], fits};
      left <= left - 1'b1;
      done <= left == 1;
    end
    if (!rst_n) begin
      left <= '0;
      done <= 1'b0;
    end
  end
endmodule
