`include "specification.svh"

// The quints of all 128 codes Q are those of the specification's formula, and each is in [0, 4].
//
// Clauses: BISE-9, BISE-10
// Engine: bmc 1
// Complete: combinational.
module prove_quints (input logic [6:0] code);
  logic [8:0] quints;
  hmlfc_quints dut (.code(code), .quints(quints));
  always @* begin
    assert (quints == spec_quints(code));
    for (integer i = 0; i < 3; i = i + 1) assert (quints[3*i +: 3] <= 4);
  end
endmodule
