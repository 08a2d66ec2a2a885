// The blocks of a plane in the order of strips, with any stalls, from any block, and at the start: columns of 16
// blocks, in a column row by row, in a row left to right; the address is destination + the columns' to the left + by *
// pitch + the strips' to the left in the row; the first and the last block of a strip are marked. BLOCK_LOG2 = 2.
//
// Clauses: The reference area (docs/decode_unit.md)
// Engine: bmc 2
// Complete: a step from any block, and the start; a scan comes to each block.
module prove_strip_scan #(
  parameter integer BLOCK_LOG2 = 2
) (input logic clk, input logic start, input logic advance);
  localparam integer N = hmlfc_pkg::BLOCK_BITS;
  localparam integer A = hmlfc_pkg::ADDRESS_BITS;
  localparam integer BLOCKS = 64 >> (2 * BLOCK_LOG2);  // of a strip
  (* anyconst *) logic [N-1:0] last_x;
  (* anyconst *) logic [N-1:0] last_y;
  (* anyconst *) logic [A-1:0] destination;
  (* anyconst *) logic [23:0] pitch;
  hmlfc_pkg::view_t view;
  always @* begin
    view = '0;
    view.blocks = {N'(0), last_x, N'(0), last_y};
    view.destination = destination;
    view.pitch = pitch;
  end
  logic         valid, strip_begins, strip_ends;
  logic [N-1:0] bx, by;
  logic [A-1:0] address;
  hmlfc_strip_scan #(.BLOCK_LOG2(BLOCK_LOG2)) dut (
    .clk(clk), .rst_n(1'b1), .start(start), .view(view), .valid(valid), .advance(advance), .bx(bx), .by(by),
    .strip_begins(strip_begins), .strip_ends(strip_ends), .address(address));
  (* hierconn *) wire [A-1:0] \dut.column_address ;
  (* hierconn *) wire [A-1:0] \dut.row_address ;

  // by * pitch, in the first clock by multiplication, then by addition; where the column, the row and the strip begin.
  logic         was = 1'b0;
  logic [A-1:0] rows_kept;
  wire [A-1:0]  rows = was ? rows_kept : A'(by) * A'(pitch);
  wire [A-1:0]  column = destination + A'(bx[N-1:4]) * A'(16 / BLOCKS * 128);
  wire is_legal = bx <= last_x && by <= last_y && \dut.column_address == column && \dut.row_address == column + rows &&
      address == column + rows + A'(bx[3:0] / BLOCKS) * A'(128);

  logic         was_valid, was_taken, was_start, was_end;
  logic [N-1:0] next_x, next_y, was_x, was_y;
  wire row_ends = bx == last_x || bx[3:0] == 15;
  wire moves = valid && advance && !start;
  always @* begin
    {next_x, next_y} = {bx, by};
    if (start) {next_x, next_y} = '0;
    else if (moves && !row_ends) next_x = bx + 1;
    else if (moves && by != last_y) {next_x, next_y} = {bx[N-1:4], 4'd0, by + N'(1)};
    else if (moves) {next_x, next_y} = {bx + N'(1), N'(0)};
  end
  always @(posedge clk) begin
    was <= 1'b1;
    rows_kept <= next_y == 0 ? '0 : next_y == by ? rows : rows + pitch;
    {was_valid, was_start, was_x, was_y} <= {valid, start, next_x, next_y};
    was_end <= moves && bx == last_x && by == last_y;
  end
  always @* begin
    if (!was && valid) assume (is_legal);
    if (valid) begin
      assert (is_legal);
      assert (strip_begins == (bx % BLOCKS == 0) && strip_ends == (bx % BLOCKS == BLOCKS - 1 || bx == last_x));
    end
    if (was) assert (valid == (was_start || (was_valid && !was_end)));
    if (was && valid) assert (bx == was_x && by == was_y);
  end
endmodule
