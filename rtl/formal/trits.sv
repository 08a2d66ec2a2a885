`include "specification.svh"

// The trits of all 256 codes T are those of the specification's formula, and each is in [0, 2].
//
// Clauses: BISE-8, BISE-10
// Engine: bmc 1
// Complete: combinational.
module prove_trits (input logic [7:0] code);
  logic [9:0] trits;
  hmlfc_trits dut (.code(code), .trits(trits));
  always @* begin
    assert (trits == spec_trits(code));
    for (integer i = 0; i < 5; i = i + 1) assert (trits[2*i +: 2] <= 2);
  end
endmodule
