`include "specification.svh"

// The place of value `index` = digit group * (values in one) + place: the slot is that place, the first bit is the
// digit group's. For all indices and all 40 level codes, so the multiplications that stand for divisions by 5 and 3 are
// exact.
//
// Clauses: BISE-5, BISE-6, BISE-11
// Engine: bmc 1
// Complete: combinational.
module prove_bise_place (input logic [9:0] group, input logic [2:0] place);
  generate
    for (genvar code = 0; code < 40; code = code + 1) begin : each
      localparam [14:0] LEVELS = spec_levels(code);
      localparam [2:0] DIGIT = spec_digit(LEVELS);
      localparam integer IN_GROUP = DIGIT == 3 ? 5 : DIGIT == 5 ? 3 : 1;
      localparam integer GROUP_BITS = IN_GROUP * spec_plain(LEVELS) + (DIGIT == 3 ? 8 : DIGIT == 5 ? 7 : 0);
      wire [12:0]  index = group * IN_GROUP + place;
      logic [13:0] group_bit;
      logic [2:0]  slot;
      hmlfc_bise_place dut (.index(index[9:0]), .level_code(6'(code)), .group_bit(group_bit), .slot(slot));
      always @* begin
        if (place < IN_GROUP && index <= 1023) begin
          assert (slot == place);
          assert ({18'd0, group_bit} == group * GROUP_BITS);
        end
      end
    end
  endgenerate
endmodule
