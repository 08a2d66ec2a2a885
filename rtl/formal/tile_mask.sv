// The mask of a residual tile: none, all blocks in the plane, 64 bits, or 4 bits for each quad that the first 16 name,
// and how many bits it takes; the blocks in the plane are those in the first columns and rows.
//
// Clauses: TIL-2, TIL-3
// Engine: bmc 1
// Complete: no state.
module prove_tile_mask (
  input logic clk, input logic [3:0] columns, input logic [3:0] rows, input logic [1:0] mode, input logic [79:0] field
);
  logic [63:0] in_plane, mask, inside, quads;
  logic [6:0]  bits, at;
  hmlfc_tile_mask dut (.columns(columns), .rows(rows), .mode(mode), .field(field), .in_plane(in_plane), .mask(mask),
      .bits(bits));
  // Block (i, j) has number 4 * (4 * (j / 2) + i / 2) + 2 * (j % 2) + i % 2.
  integer      i, j, q;
  always @* begin
    for (i = 0; i < 8; i = i + 1) for (j = 0; j < 8; j = j + 1) inside[4 * (4 * (j / 2) + i / 2) + 2 * (j % 2) +
        i % 2] = i < columns && j < rows;
    quads = 64'd0;
    at = 7'd16;  // of the next quad's bits
    for (q = 0; q < 16; q = q + 1) if (field[q]) begin
      quads[4*q +: 4] = field[at +: 4];
      at = at + 7'd4;
    end
  end
  always @* begin
    assert (in_plane == inside);
    assert (mask == (mode == 0 ? 64'd0 : mode == 1 ? inside : mode == 2 ? field[63:0] : quads));
    assert (bits == (mode <= 1 ? 7'd0 : mode == 2 ? 7'd64 : at));
  end
endmodule
