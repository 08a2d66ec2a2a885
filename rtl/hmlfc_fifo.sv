// A queue of DEPTH words.
//
// WIDTH   >= 1, bits of a word
// DEPTH   a power of two, >= 2
//
// A word passes when valid and ready are both high; valid does not wait for ready. A word put in is
// offered on the next clock. in_ready is low with DEPTH words inside, also while one is taken.
// count   words inside, [0, DEPTH]
// rst_n   active low, taken synchronously: empties the queue
module hmlfc_fifo #(
  parameter integer WIDTH = 8,
  parameter integer DEPTH = 4
) (
  input  logic                     clk,
  input  logic                     rst_n,
  input  logic                     in_valid,
  output logic                     in_ready,
  input  logic [WIDTH-1:0]         in_data,
  output logic                     out_valid,
  input  logic                     out_ready,
  output logic [WIDTH-1:0]         out_data,
  output logic [$clog2(DEPTH):0]   count
);
  localparam integer INDEX_BITS = $clog2(DEPTH);
  localparam [INDEX_BITS:0] ONE = {{INDEX_BITS{1'b0}}, 1'b1};

  logic [WIDTH-1:0]    storage [0:DEPTH-1];
  logic [INDEX_BITS:0] written, taken;  // words so far, modulo 2 * DEPTH

  assign count = written - taken;
  assign in_ready = !count[INDEX_BITS];
  assign out_valid = written != taken;
  assign out_data = storage[taken[INDEX_BITS-1:0]];

  always_ff @(posedge clk) begin
    if (in_valid && in_ready) storage[written[INDEX_BITS-1:0]] <= in_data;
    if (!rst_n) begin
      written <= {(INDEX_BITS + 1) {1'b0}};
      taken <= {(INDEX_BITS + 1) {1'b0}};
    end else begin
      if (in_valid && in_ready) written <= written + ONE;
      if (out_valid && out_ready) taken <= taken + ONE;
    end
  end
endmodule
