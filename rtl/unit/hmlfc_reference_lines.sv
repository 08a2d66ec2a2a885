// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Keeps the lines of strips and gives the samples of windows from them, one window a clock, in order.
//
// BLOCK_LOG2    [1, 3], B = 2^BLOCK_LOG2; a line is one block, a strip 64 samples, so 64 / B^2 lines
// PLACE_BITS    2^PLACE_BITS strips in each of four banks by the parity of a strip's row and column
//
// write              strip `write_place` = {bank, place in it} becomes `write_lines`, each {error, samples}
// in_*               a window as hmlfc_reference_window describes it, and the places of its strips in the four banks
// out_window         sample (i, j) of the window at bits SAMPLE_BITS * (j * (B + 1) + i) on
// out_error          the first of the blocks that the window touches, row by row (DEC-7)
// spoiled            for a clock: a window met bus_error in one of its blocks
//
// Lines lie in banks by the parity of the row and by their place in the strip, so that a strip is written in one clock
// and a window, which touches at most 2 x 2 blocks, is read in one. Latency 3 clocks.
module hmlfc_reference_lines #(
    parameter int BLOCK_LOG2 = 2,
    parameter int SAMPLE_BITS = 10,
    parameter int PLACE_BITS = 7,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS,
    localparam int B = 1 << BLOCK_LOG2,
    localparam int SIDE = B + 1,
    localparam int SELECT_BITS = BLOCK_LOG2 + 1,
    localparam int SAMPLES = B * B,
    localparam int LINES = 64 / SAMPLES,
    localparam int LINE_BITS = 6 + SAMPLES * SAMPLE_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic write,
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
    output logic [SIDE*SIDE*SAMPLE_BITS-1:0] out_window,
    output logic spoiled
);

  // Banks: {parity of the row, line of the strip}, or with one line {row, strip} parity.
  localparam int LINES_LOG2 = $clog2(LINES);
  localparam int COLUMNS = LINES > 1 ? LINES : 2;
  localparam int COLUMN_BITS = $clog2(COLUMNS);
  localparam int LINE_PLACE_BITS = LINES > 1 ? PLACE_BITS + 1 : PLACE_BITS;

  logic [3:1] valid;
  wire advance = !valid[3] || out_ready;
  assign in_ready = advance;
  assign out_valid = valid[3];
  wire [COLUMN_BITS-1:0] left_column = in_block_x[COLUMN_BITS-1:0];
  wire left_parity = in_block_x[LINES_LOG2];

  // 1: lines of both rows in all columns.
  logic [2*COLUMNS*LINE_BITS-1:0] lines_1;
  for (genvar r = 0; r < 2; r++) begin : g_row
    wire [PLACE_BITS-1:0] even = in_places[(2*r)*PLACE_BITS+:PLACE_BITS];
    wire [PLACE_BITS-1:0] odd = in_places[(2*r+1)*PLACE_BITS+:PLACE_BITS];
    for (genvar c = 0; c < COLUMNS; c++) begin : g_column
      logic [LINE_PLACE_BITS-1:0] write_at, read_at;
      logic write_here;
      // The right block is in the next strip where its column is less than the left one's.
      logic parity;
      if (LINES > 1) begin : g_lines
        assign write_here = write && write_place[PLACE_BITS+1] == 1'(r);
        assign write_at = write_place[PLACE_BITS:0];
        /* verilator lint_off CMPCONST */  // always for the last column
        assign parity = COLUMN_BITS'(c) >= left_column ? left_parity : !left_parity;
        /* verilator lint_on CMPCONST */
        assign read_at = {parity, parity ? odd : even};
      end else begin : g_line
        assign write_here = write && write_place[PLACE_BITS+1:PLACE_BITS] == {1'(r), 1'(c)};
        assign write_at = write_place[PLACE_BITS-1:0];
        assign parity = 1'(c);
        assign read_at = parity ? odd : even;
      end
      // No line of a window is read in the clock in which it is written.
      hmlfc_ram #(
          .WIDTH(LINE_BITS),
          .DEPTH(1 << LINE_PLACE_BITS)
      ) memory (
          .clk,
          .write(write_here),
          .write_address(write_at),
          .write_data(write_lines[(LINES>1?c : 0)*LINE_BITS+:LINE_BITS]),
          .read(advance),
          .read_address(read_at),
          .read_data(lines_1[(r*COLUMNS+c)*LINE_BITS+:LINE_BITS])
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
      for (int c = b % 2; c < COLUMNS; c += 2) begin
        blocks_next[b*LINE_BITS+:LINE_BITS] = blocks_next[b*LINE_BITS+:LINE_BITS] |
            (lines_1[((b/2)*COLUMNS+c)*LINE_BITS+:LINE_BITS] &
             {LINE_BITS{columns[(b%2)*COLUMN_BITS+:COLUMN_BITS] == COLUMN_BITS'(c)}});
      end
    end
  end

  // 3: samples: of each row of the window those of both blocks in it, then one for each column. Row k of one of both
  // blocks serves all rows of the window but the last: of the upper one where k is not less than the first row's.
  localparam logic [SELECT_BITS-1:0] IN_BLOCK = SELECT_BITS'(B - 1);
  wire [SELECT_BITS-1:0] odd_x = SELECT_BITS'(first_2[0]) << BLOCK_LOG2;
  wire [SELECT_BITS-1:0] odd_y = SELECT_BITS'(first_2[1]) << BLOCK_LOG2;
  logic [B-1:0] upper_x_2, upper_y_2;
  logic [2*B*B*SAMPLE_BITS-1:0] shared_rows;
  logic [SIDE*B*SAMPLE_BITS-1:0] shared_columns;
  logic [SIDE*2*B*SAMPLE_BITS-1:0] rows;
  logic [SIDE*SIDE*SAMPLE_BITS-1:0] window;
  always_comb begin
    rows = '0;
    window = '0;
    for (int k = 0; k < B; k++) begin
      for (int x = 0; x < 2 * B; x++) begin
        shared_rows[(k*2*B+x)*SAMPLE_BITS+:SAMPLE_BITS] = upper_y_2[k] ^ first_2[1] ?
            blocks_2[(x/B)*LINE_BITS+(k*B+x%B)*SAMPLE_BITS+:SAMPLE_BITS] :
            blocks_2[(2+x/B)*LINE_BITS+(k*B+x%B)*SAMPLE_BITS+:SAMPLE_BITS];
      end
    end
    for (int j = 0; j < B; j++) begin
      for (int k = 0; k < B; k++) begin
        rows[j*2*B*SAMPLE_BITS+:2*B*SAMPLE_BITS] = rows[j*2*B*SAMPLE_BITS+:2*B*SAMPLE_BITS] |
            (shared_rows[k*2*B*SAMPLE_BITS+:2*B*SAMPLE_BITS] &
             {2*B*SAMPLE_BITS{(select_y_2[j*SELECT_BITS+:SELECT_BITS] & IN_BLOCK) == SELECT_BITS'(k)}});
      end
    end
    for (int y = 0; y < 2 * B; y++) begin
      for (int x = 0; x < 2 * B; x++) begin
        rows[(B*2*B+x)*SAMPLE_BITS+:SAMPLE_BITS] = rows[(B*2*B+x)*SAMPLE_BITS+:SAMPLE_BITS] |
            (blocks_2[((y/B)*2+(x/B))*LINE_BITS+((y%B)*B+x%B)*SAMPLE_BITS+:SAMPLE_BITS] &
             {SAMPLE_BITS{(select_y_2[B*SELECT_BITS+:SELECT_BITS] ^ odd_y) == SELECT_BITS'(y)}});
      end
    end
    for (int j = 0; j < SIDE; j++) begin
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
      valid <= {valid[2:1], in_valid};
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
      out_error <= error;
      out_window <= window;
    end
    if (!rst_n) valid <= '0;
  end

endmodule

`default_nettype wire
