// The scan of a rectangle of blocks, with any stalls, from each position that a scan comes to, and at its start:
// positions rise in scan order, and stay until they are taken; no block of the rectangle is left out; has_block says
// whether the rectangle has the block; tile_ends, after the last position of any tile of which the rectangle has
// blocks, and after no other; macro_ends where the next one is of another macro row.
//
// Clauses: none: the order of blocks (docs/decode_unit.md)
// Engine: bmc 2
// Complete: a step from any position, and the start; a scan comes to each block, and to what is passed at its begin.
module prove_view_scan (input logic clk, input logic start, input logic advance);
  localparam integer N = hmlfc_pkg::BLOCK_BITS;
  (* anyconst *) logic [N-1:0] first_x;
  (* anyconst *) logic [N-1:0] last_x;
  (* anyconst *) logic [N-1:0] first_y;
  (* anyconst *) logic [N-1:0] last_y;
  logic         valid, has_block, tile_ends, macro_ends;
  logic [N-1:0] bx, by;
  hmlfc_view_scan dut (
    .clk(clk), .rst_n(1'b1), .start(start), .blocks({first_x, last_x, first_y, last_y}), .valid(valid),
    .advance(advance), .has_block(has_block), .bx(bx), .by(by), .tile_ends(tile_ends), .macro_ends(macro_ends));

  // What sorts blocks: macro row; column of squares; square, tile, quad and block in it, row by row.
  function automatic [2*N-1:0] order(input [N-1:0] x, input [N-1:0] y);
    order = {y[N-1:5], x[N-1:4], y[4], y[3], x[3], y[2:1], x[2:1], y[0], x[0]};
  endfunction
  function automatic inside(input [N-1:0] x, input [N-1:0] y);
    inside = x >= first_x && x <= last_x && y >= first_y && y <= last_y;
  endfunction
  // Whether the rectangle has blocks of the square of this side that a block is in.
  function automatic has(input [N-1:0] x, input [N-1:0] y, input [N-1:0] side);
    has = (x | (side - 1)) >= first_x && (x & ~(side - 1)) <= last_x && (y | (side - 1)) >= first_y &&
        (y & ~(side - 1)) <= last_y;
  endfunction

  // Positions that a scan comes to: what has no block is passed at its begin, columns and macro rows without any never.
  wire [2*N-1:0] now = order(bx, by);
  wire is_legal = bx[N-1:4] >= first_x[N-1:4] && bx[N-1:4] <= last_x[N-1:4] && by[N-1:5] >= first_y[N-1:5] &&
      by[N-1:5] <= last_y[N-1:5] &&
      (has(bx, by, 2) || now[1:0] == 0) && (((by | 1) >= first_y && (by & ~1) <= last_y) || now[3:0] == 0) &&
      (has(bx, by, 8) || now[5:0] == 0) && (has(bx, by, 16) || now[7:0] == 0);

  // Any block of the rectangle; the clock before.
  (* anyconst *) logic [N-1:0] watched_x;
  (* anyconst *) logic [N-1:0] watched_y;
  wire [2*N-1:0]  watched = order(watched_x, watched_y);
  logic           was = 1'b0;
  logic           was_valid, was_taken, was_start, was_tile, was_tile_ends, was_macro_ends;
  logic [2*N-1:0] before;
  always @(posedge clk) begin
    was <= 1'b1;
    {was_valid, was_taken, was_start, was_tile, was_tile_ends, was_macro_ends, before} <=
        {valid, advance, start, has(bx, by, 8), tile_ends, macro_ends, now};
  end
  wire moves = was_valid && was_taken && !was_start;
  always @* begin
    assume (first_x <= last_x && first_y <= last_y && inside(watched_x, watched_y));
    if (!was && valid) assume (is_legal);
    if (valid) assert (is_legal && has_block == inside(bx, by));
    if (was && was_start) assert (valid && now <= watched);
    if (was && !was_start && !(was_valid && was_taken)) assert (valid == was_valid && (!valid || now == before));
    if (was && moves) begin
      assert (watched <= before || (valid && watched >= now));
      if (valid) assert (now > before && was_macro_ends == (now[2*N-1 -: N-5] != before[2*N-1 -: N-5]));
      assert (was_tile_ends == (was_tile && (!valid || now[2*N-1:6] != before[2*N-1:6])));
    end
  end
endmodule
