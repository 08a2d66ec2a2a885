// The place of a block but its address, with any stalls, for any position of the scan: its tile's number, its place in the tile, and what ends in it.
// From a macro row to the next the macro row's address and the tiles grow by a macro row. A start takes the destination and the tiles above it.
// Reset and start leave nothing of an earlier scan.
//
// Clauses: Descriptors (docs/view_unit.md)
// Engine: bmc 4
// Complete: the clocks from a position to its place, with a stall; which positions a scan comes to is proved of view_scan.
// Cover: 4
// Fault: hmlfc_view_place.sv / 22'(tile_x) / 22'(tile_x[5:0])
// Fault: hmlfc_view_place.sv / by == view.blocks.last_y ? / by[7:0] == view.blocks.last_y[7:0] ?
// Fault: hmlfc_view_place.sv / !rst_n || start) valid / start) valid
// Fault: hmlfc_view_place.sv / {10'd0, tiles_x, 2'd0} / {11'd0, tiles_x, 1'b0}
// Fault: hmlfc_view_place.sv / macro_address <= macro_address + ADDRESS_BITS'(weight) / macro_address <= macro_address + ADDRESS_BITS'(row_bytes)
module prove_view_place #(
  parameter integer BLOCK_LOG2 = 1
) (input logic clk, input logic rst_n, input logic start, input logic place_ready);
  localparam integer A = hmlfc_pkg::ADDRESS_BITS;
  localparam integer N = hmlfc_pkg::BLOCK_BITS;
  localparam integer R = 24 + BLOCK_LOG2;
  (* anyconst *) hmlfc_pkg::view_t view;
  hmlfc_pkg::place_t place;
  logic done, place_valid;
  hmlfc_view_place #(.BLOCK_LOG2(BLOCK_LOG2)) dut (
    .clk(clk), .rst_n(rst_n), .start(start), .view(view), .done(done), .place_valid(place_valid), .place_ready(place_ready), .place(place));
  (* hierconn *) wire         \dut.starting ;
  (* hierconn *) wire [2:0]   \dut.step ;
  (* hierconn *) wire [4:0]   \dut.above ;
  (* hierconn *) wire [R+4:0] \dut.weight ;
  (* hierconn *) wire [A-1:0] \dut.macro_address ;
  (* hierconn *) wire [21:0]  \dut.macro_tile ;
  (* hierconn *) wire         \dut.scan_valid ;
  (* hierconn *) wire         \dut.scan_block ;
  (* hierconn *) wire         \dut.scan_tile_ends ;
  (* hierconn *) wire         \dut.scan_macro_ends ;
  (* hierconn *) wire [N-1:0] \dut.bx ;
  (* hierconn *) wire [N-1:0] \dut.by ;
  (* hierconn *) wire [3:1]   \dut.valid ;
  wire [N-1:0] bx = \dut.bx , by = \dut.by ;
  wire         go = !place_valid || place_ready;

  // The place of the position at which the scan is.
  wire [R-1:0] row = {view.pitch, BLOCK_LOG2'(0)};  // bytes of a row of blocks
  wire [A-1:0] rows = A'(row);
  wire [9:0]   tiles = view.blocks.last_x[N-1:3] - view.blocks.first_x[N-1:3] + 1;  // in a row
  wire [21:0]  t = 22'(tiles);
  function automatic [21:0] tile_rows(input [1:0] count);
    tile_rows = count == 0 ? 22'd0 : count == 1 ? t : count == 2 ? t << 1 : t + (t << 1);
  endfunction
  wire [9:0]   tile_x = bx[N-1:3] - view.blocks.first_x[N-1:3];
  hmlfc_pkg::place_t now, now_1, now_2, now_3;
  always @* begin
    now = '0;
    now.has_block = \dut.scan_block ;
    now.tile_ends = \dut.scan_tile_ends ;
    now.tile_x = bx[2:0];
    now.tile_y = by[2:0];
    now.tile = \dut.macro_tile + tile_rows(by[4:3]) + 22'(tile_x);
    now.end_column = bx == view.blocks.last_x ? view.end_column : 3'((1 << BLOCK_LOG2) - 1);
    now.end_row = by == view.blocks.last_y ? view.end_row : 3'((1 << BLOCK_LOG2) - 1);
  end

  logic [2:0]   filled = 3'd0;  // places that have come from `now`
  logic [2:0]   held = 3'd0;    // and are to come out
  logic         was = 1'b0;
  logic         was_reset, was_start, was_starting, was_add;
  logic [A-1:0] next_address;
  logic [21:0]  next_tile;
  // The weight is a row of blocks, doubled with each step, when the scan begins a macro row.
  wire is_legal = \dut.step <= 5 && !(\dut.starting && (\dut.scan_valid || \dut.valid != 0)) &&
      (!(\dut.starting || \dut.scan_valid ) || \dut.weight == {5'd0, row} << (\dut.starting ? \dut.step : 3'd5));
  wire begins = \dut.starting && \dut.step == 5;
  always @(posedge clk) begin
    was <= 1'b1;
    {was_reset, was_start, was_starting} <= {!rst_n, start, \dut.starting && !begins};
    was_add <= rst_n && !start && !\dut.starting && \dut.scan_valid && go && \dut.scan_macro_ends ;
    next_address <= \dut.macro_address + (rows << 5);
    next_tile <= \dut.macro_tile + (t << 2);
    if (go) {now_3, now_2, now_1, filled} <= {now_2, now_1, now, filled[1:0], 1'b1};
    if (!rst_n || start) held <= 3'd0;
    else if (go) held <= {held[1:0], \dut.scan_valid };
  end
  always @* begin
    assume (view.end_column < 1 << BLOCK_LOG2 && view.end_row < 1 << BLOCK_LOG2);
    if (!was) assume (is_legal && held == \dut.valid );
    if (was) assert (is_legal);
    if (was && (was_reset || was_start)) assert (!place_valid && \dut.valid == 0);
    if (was && was_start) assert (\dut.above == view.blocks.first_y[4:0] && \dut.macro_address == view.destination &&
        \dut.macro_tile == 22'd0 - tile_rows(view.blocks.first_y[4:3]));
    if (was && was_add) assert (\dut.macro_address == next_address && \dut.macro_tile == next_tile);
    if (was) assert (place_valid == held[2]);
    if (filled[2] && place_valid) assert (place[75:A] == now_3[75:A]);
    assert (done == (!start && !\dut.starting && !\dut.scan_valid && \dut.valid == 0));
    cover (filled[2] && place_valid && place.has_block);
  end
endmodule
