// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The mask of a residual tile that begins in `field` (TIL-2, TIL-3): which of its 64 blocks have motion, or a residual.
//
// columns, rows  [1, 8], of the tile's blocks that lie in the plane
// field          the next 80 bits of the record
// in_plane       the blocks that lie in the plane, as a mask
// bits           [0, 80], the length of what the mode stands for
// Combinational.
module hmlfc_tile_mask (
    input logic [3:0] columns,
    input logic [3:0] rows,
    input logic [1:0] mode,
    input logic [79:0] field,
    output logic [63:0] in_plane,
    output logic [63:0] mask,
    output logic [6:0] bits
);

  // Mode 3: 4 bits for each quad of `quads`, packed in `blocks`.
  function automatic logic [63:0] quad_mask(input logic [15:0] quads, input logic [63:0] blocks);
    logic [3:0] base;     // quads in the fours before this one's: a short chain of additions
    logic [2:0] in_four;  // and before it in its own
    base = '0;
    in_four = '0;
    quad_mask = '0;
    for (int q = 0; q < 16; q++) begin
      if (q % 4 == 0) begin
        base = base + 4'(in_four);
        in_four = '0;
      end
      if (quads[q]) begin
        quad_mask[4*q+:4] = 4'(blocks >> {base + 4'(in_four), 2'b00});
        in_four = in_four + 3'd1;
      end
    end
  endfunction

  always_comb begin
    for (int k = 0; k < 64; k++) begin
      in_plane[k] = 4'(2 * ((k >> 2) & 3) + (k & 1)) < columns && 4'(2 * (k >> 4) + ((k >> 1) & 1)) < rows;
    end
    mask = '0;
    bits = '0;
    unique case (mode)
      2'd1: mask = in_plane;
      2'd2: begin
        mask = field[63:0];
        bits = 7'd64;
      end
      2'd3: begin
        mask = quad_mask(field[15:0], field[79:16]);
        bits = 7'd16 + {5'($countones(field[15:0])), 2'b00};
      end
      default: ;
    endcase
  end

endmodule

`default_nettype wire
