// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Keeps the lines of strips and gives the samples of windows from them, one window in CLOCKS clocks, in order.
//
// BLOCK_LOG2    [1, 3], B = 2^BLOCK_LOG2; a line is one block, a strip 64 samples, so 64 / B^2 lines
// PLACE_BITS    2^PLACE_BITS strips in each of four banks by the parity of a strip's row and column
// CLOCKS        [1, B], a power of two: a window comes in so many parts of B / CLOCKS + 1 rows; the last row of a part
//               is the first of the next
//
// write              a half of strip `write_place` = {bank, place in it}, the first or with `write_half` the second,
//                    becomes that of `write_lines`, each {error, samples}; all of it with CLOCKS = 1
// in_*               a window: its samples (i, j) lie in column select_x[i], row select_y[j] of blocks from (block_x,
//                    block_y) on, two_x and two_y beside it; and the places of its strips in the four banks
// out_window         sample (i, j) of the part at bits SAMPLE_BITS * (j * (B + 1) + i) on
// out_error          the first of the blocks that the window touches, row by row (DEC-7)
// spoiled            for a clock: a window met bus_error in one of its blocks
//
// A window touches at most 2 x 2 blocks, which lie in four memories and are read in one clock. Latency 3 clocks.
module hmlfc_reference_lines #(
    parameter int BLOCK_LOG2 = 2,
    parameter int SAMPLE_BITS = 10,
    parameter int PLACE_BITS = 7,
    parameter int CLOCKS = 1,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS,
    localparam int B = 1 << BLOCK_LOG2,
    localparam int ROWS = B / CLOCKS,
    localparam int SIDE = B + 1,
    localparam int SELECT_BITS = BLOCK_LOG2 + 1,
    localparam int SAMPLES = B * B,
    localparam int LINES = 64 / SAMPLES,
    localparam int LINE_BITS = 6 + SAMPLES * SAMPLE_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic write,
    input logic write_half,
    input logic [PLACE_BITS+1:0] write_place,
    input logic [LINES*LINE_BITS-1:0] write_lines,

    input logic in_valid,
    output logic in_ready,
    input logic [BLOCK_BITS-1:0] in_block_x,
    input logic [BLOCK_BITS-1:0] in_block_y,
    input logic in_two_x,
    input logic in_two_y,
    input logic [SIDE*SELECT_BITS-1:0] in_select_x,
    input logic [SIDE*SELECT_BITS-1:0] in_select_y,
    input logic [4*PLACE_BITS-1:0] in_places,

    output logic out_valid,
    input logic out_ready,
    output logic [5:0] out_error,
    output logic [(ROWS+1)*SIDE*SAMPLE_BITS-1:0] out_window,
    output logic spoiled
);

  // Memories: of the parity of the row and of the line of the strip, with HALVES of the line in its half, the second
  // above the first; or with one line of the parities of row and strip.
  localparam int LINES_LOG2 = $clog2(LINES);
  localparam int COLUMNS = LINES > 1 ? LINES : 2;
  localparam int COLUMN_BITS = $clog2(COLUMNS);
  localparam bit HALVES = CLOCKS > 1 && LINES > 1;
  localparam int MEMORIES = HALVES ? LINES / 2 : COLUMNS;  // of a row
  localparam int SECOND = HALVES ? MEMORIES : 0;  // where a strip's second half begins
  localparam int LINE_PLACE_BITS = HALVES ? PLACE_BITS + 2 : LINES > 1 ? PLACE_BITS + 1 : PLACE_BITS;
  localparam int PART_BITS = $clog2(CLOCKS) > 0 ? $clog2(CLOCKS) : 1;

  logic [3:1] valid;
  logic [PART_BITS-1:0] part;
  wire step = !valid[3] || out_ready;
  wire advance = step && (CLOCKS == 1 || !valid[2] || part == PART_BITS'(CLOCKS - 1));
  assign in_ready = advance;
  assign out_valid = valid[3];
  wire [COLUMN_BITS-1:0] left_column = in_block_x[COLUMN_BITS-1:0];
  wire left_parity = in_block_x[LINES_LOG2];

  // 1: lines of both rows from all memories: of the left block and, from another memory, of the right one.
  logic [2*MEMORIES*LINE_BITS-1:0] lines_1;
  for (genvar r = 0; r < 2; r++) begin : g_row
    wire [PLACE_BITS-1:0] even = in_places[(2*r)*PLACE_BITS+:PLACE_BITS];
    wire [PLACE_BITS-1:0] odd = in_places[(2*r+1)*PLACE_BITS+:PLACE_BITS];
    for (genvar m = 0; m < MEMORIES; m++) begin : g_memory
      logic [LINE_PLACE_BITS-1:0] write_at, read_at;
      logic [LINE_BITS-1:0] line;
      logic write_here;
      if (LINES > 1) begin : g_lines
        wire [COLUMN_BITS-1:0] right_column = left_column + 1'b1;
        wire left = (left_column ^ COLUMN_BITS'(m)) << HALVES == '0;  // but for the half
        wire half = left ? left_column[COLUMN_BITS-1] : right_column[COLUMN_BITS-1];
        wire parity = left_parity ^ (!left && right_column == '0);
        assign write_here = write && write_place[PLACE_BITS+1] == 1'(r);
        assign write_at = LINE_PLACE_BITS'({write_half, write_place[PLACE_BITS:0]});
        assign line = write_half ? write_lines[(SECOND+m)*LINE_BITS+:LINE_BITS] : write_lines[m*LINE_BITS+:LINE_BITS];
        assign read_at = LINE_PLACE_BITS'({half, parity, parity ? odd : even});
      end else begin : g_line
        assign write_here = write && !write_half && write_place[PLACE_BITS+1:PLACE_BITS] == {1'(r), 1'(m)};
        assign write_at = write_place[PLACE_BITS-1:0];
        assign line = write_lines;
        assign read_at = m == 1 ? odd : even;
      end
      // No line of a window is read in the clock in which it is written.
      hmlfc_ram #(.WIDTH(LINE_BITS), .DEPTH(1 << LINE_PLACE_BITS)) memory (
          .clk, .write(write_here), .write_address(write_at), .write_data(line), .read(advance), .read_address(read_at),
          .read_data(lines_1[(r*MEMORIES+m)*LINE_BITS+:LINE_BITS])
      );
    end
  end

  // 2: the four blocks, by the parities {row, column} of their places: one of two neighbours is even.
  logic [COLUMN_BITS-1:0] column_1;
  logic row_1, two_x_1, two_y_1, two_x_2, two_y_2;
  logic [1:0] first_2;  // parities of the upper left block
  logic [SIDE*SELECT_BITS-1:0] select_x_1, select_y_1, select_x_2, select_y_2;
  logic [4*LINE_BITS-1:0] blocks_next, blocks_2;
  wire [2*COLUMN_BITS-1:0] columns = {column_1 | COLUMN_BITS'(1), column_1 + COLUMN_BITS'(column_1[0])};  // {odd, even}
  always_comb begin
    blocks_next = '0;
    for (int b = 0; b < 4; b++) begin
      for (int m = b % 2; m < MEMORIES; m += 2) begin
        if (((columns[(b%2)*COLUMN_BITS+:COLUMN_BITS] ^ COLUMN_BITS'(m)) & COLUMN_BITS'(MEMORIES - 1)) == '0)
          blocks_next[b*LINE_BITS+:LINE_BITS] = lines_1[((b/2)*MEMORIES+m)*LINE_BITS+:LINE_BITS];
      end
    end
  end

  // 3: samples: of each row of the window those of both blocks in it, then one for each column. Row k of one of both
  // blocks serves all rows of the window but the last: of the upper one where k is not less than the first row's.
  localparam logic [SELECT_BITS-1:0] IN_BLOCK = SELECT_BITS'(B - 1);
  wire [SELECT_BITS-1:0] odd_x = SELECT_BITS'(first_2[0]) << BLOCK_LOG2;
  wire [SELECT_BITS-1:0] odd_y = SELECT_BITS'(first_2[1]) << BLOCK_LOG2;
  logic [B-1:0] upper_x_2, upper_y_2;
  logic [(ROWS+1)*SELECT_BITS-1:0] select_rows;  // those of the part
  logic [2*B*B*SAMPLE_BITS-1:0] shared_rows;
  logic [(ROWS+1)*B*SAMPLE_BITS-1:0] shared_columns;
  logic [(ROWS+1)*2*B*SAMPLE_BITS-1:0] rows;
  logic [(ROWS+1)*SIDE*SAMPLE_BITS-1:0] window;
  always_comb begin
    rows = '0;
    window = '0;
    select_rows = '0;
    for (int i = 0; i < CLOCKS; i++) begin
      if (CLOCKS == 1 || part == PART_BITS'(i)) select_rows = select_y_2[i*ROWS*SELECT_BITS+:(ROWS+1)*SELECT_BITS];
    end
    for (int k = 0; k < B; k++) begin
      for (int x = 0; x < 2 * B; x++) begin
        shared_rows[(k*2*B+x)*SAMPLE_BITS+:SAMPLE_BITS] = upper_y_2[k] ^ first_2[1] ?
            blocks_2[(x/B)*LINE_BITS+(k*B+x%B)*SAMPLE_BITS+:SAMPLE_BITS] :
            blocks_2[(2+x/B)*LINE_BITS+(k*B+x%B)*SAMPLE_BITS+:SAMPLE_BITS];
      end
    end
    for (int j = 0; j < ROWS; j++) begin
      for (int k = 0; k < B; k++) begin
        rows[j*2*B*SAMPLE_BITS+:2*B*SAMPLE_BITS] = rows[j*2*B*SAMPLE_BITS+:2*B*SAMPLE_BITS] |
            (shared_rows[k*2*B*SAMPLE_BITS+:2*B*SAMPLE_BITS] &
             {2*B*SAMPLE_BITS{(select_rows[j*SELECT_BITS+:SELECT_BITS] & IN_BLOCK) == SELECT_BITS'(k)}});
      end
    end
    for (int y = 0; y < 2 * B; y++) begin
      for (int x = 0; x < 2 * B; x++) begin
        rows[(ROWS*2*B+x)*SAMPLE_BITS+:SAMPLE_BITS] = rows[(ROWS*2*B+x)*SAMPLE_BITS+:SAMPLE_BITS] |
            (blocks_2[((y/B)*2+(x/B))*LINE_BITS+((y%B)*B+x%B)*SAMPLE_BITS+:SAMPLE_BITS] &
             {SAMPLE_BITS{(select_rows[ROWS*SELECT_BITS+:SELECT_BITS] ^ odd_y) == SELECT_BITS'(y)}});
      end
    end
    for (int j = 0; j <= ROWS; j++) begin
      for (int k = 0; k < B; k++) begin
        shared_columns[(j*B+k)*SAMPLE_BITS+:SAMPLE_BITS] = upper_x_2[k] ^ first_2[0] ?
            rows[(j*2*B+k)*SAMPLE_BITS+:SAMPLE_BITS] : rows[(j*2*B+B+k)*SAMPLE_BITS+:SAMPLE_BITS];
      end
      for (int i = 0; i < B; i++) begin
        for (int k = 0; k < B; k++) begin
          window[(j*SIDE+i)*SAMPLE_BITS+:SAMPLE_BITS] = window[(j*SIDE+i)*SAMPLE_BITS+:SAMPLE_BITS] |
              (shared_columns[(j*B+k)*SAMPLE_BITS+:SAMPLE_BITS] &
               {SAMPLE_BITS{(select_x_2[i*SELECT_BITS+:SELECT_BITS] & IN_BLOCK) == SELECT_BITS'(k)}});
        end
      end
      for (int x = 0; x < 2 * B; x++) begin
        window[(j*SIDE+B)*SAMPLE_BITS+:SAMPLE_BITS] = window[(j*SIDE+B)*SAMPLE_BITS+:SAMPLE_BITS] |
            (rows[(j*2*B+x)*SAMPLE_BITS+:SAMPLE_BITS] &
             {SAMPLE_BITS{(select_x_2[B*SELECT_BITS+:SELECT_BITS] ^ odd_x) == SELECT_BITS'(x)}});
      end
    end
  end
  function automatic logic [5:0] error_of(input logic [4*LINE_BITS-1:0] blocks, input logic [1:0] block);
    error_of = '0;
    for (int b = 0; b < 4; b++) begin
      if (block == 2'(b)) error_of = blocks[b*LINE_BITS+SAMPLES*SAMPLE_BITS+:6];
    end
  endfunction
  wire [5:0] error_left = error_of(blocks_2, first_2);
  wire [5:0] error_right = error_of(blocks_2, first_2 ^ 2'b01) & {6{two_x_2}};
  wire [5:0] error_below = error_of(blocks_2, first_2 ^ 2'b10) & {6{two_y_2}};
  wire [5:0] error_corner = error_of(blocks_2, ~first_2) & {6{two_x_2 && two_y_2}};
  wire [5:0] error = error_left != 0 ? error_left : error_right != 0 ? error_right :
      error_below != 0 ? error_below : error_corner;
  assign spoiled = valid[2] && advance &&
      (error_left == HMLFC_ERROR_BUS_ERROR || error_right == HMLFC_ERROR_BUS_ERROR ||
       error_below == HMLFC_ERROR_BUS_ERROR || error_corner == HMLFC_ERROR_BUS_ERROR);

  always_ff @(posedge clk) begin
    if (advance) begin
      valid[2:1] <= {valid[1], in_valid};
      column_1 <= left_column;
      row_1 <= in_block_y[0];
      {two_x_1, two_y_1, select_x_1, select_y_1} <= {in_two_x, in_two_y, in_select_x, in_select_y};
      {two_x_2, two_y_2, first_2} <= {two_x_1, two_y_1, row_1, column_1[0]};
      {select_x_2, select_y_2} <= {select_x_1, select_y_1};
      for (int k = 0; k < B; k++) begin
        upper_x_2[k] <= SELECT_BITS'(k) >= (select_x_1[SELECT_BITS-1:0] & IN_BLOCK);
        upper_y_2[k] <= SELECT_BITS'(k) >= (select_y_1[SELECT_BITS-1:0] & IN_BLOCK);
      end
      blocks_2 <= blocks_next;
    end
    if (step) begin
      valid[3] <= valid[2];
      out_error <= error;
      out_window <= window;
    end
    if (!rst_n || advance) part <= '0;
    else if (step) part <= part + 1'b1;
    if (!rst_n) valid <= '0;
  end

endmodule

`default_nettype wire
