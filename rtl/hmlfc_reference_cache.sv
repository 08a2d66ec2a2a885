`include "hmlfc_tables.svh"

// Fetches the samples of one reference of each block, through a cache of strips.
//
// Takes windows in order (`in_*`) and gives their samples in the same order, one window a clock while the
// cache hits. Tags are looked up when a window enters, and what misses is asked for at once; the window
// then waits in a queue until its strips have come. So the latency of the memory is hidden as
// long as the queue is not full. Strips are filled in the order in which they were asked for, and a fill
// waits for the windows in front that still read the lines it replaces.
//
// The cache is four banks of tags by the parity of a strip's row and column. Lines, of one block each, lie in
// banks by the parity of the row and by their place in the strip, so that a strip is written in one clock and a
// window, which touches at most 2 x 2 blocks, is read in one. A strip has one place:
// luma uses half of the places, each chroma plane a quarter; with SECTIONS = 2 `in_section` chooses the half of the cache.
module hmlfc_reference_cache #(
    parameter int BLOCK_LOG2 = 2,
    parameter int SAMPLE_BITS = 10,
    parameter int DATA_BITS = 128,
    parameter int STRIPS = 512,  // kept; a power of two, at least 64
    parameter int SECTIONS = 1,  // 1, 2
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS,
    localparam int SIDE = (1 << BLOCK_LOG2) + 1,
    localparam int SELECT_BITS = BLOCK_LOG2 + 1,
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,
    input logic flush,

    input logic in_valid,
    output logic in_ready,
    input logic [ADDRESS_BITS-1:0] in_address,  // of the plane in the reference area
    input logic [1:0] in_plane,
    input logic in_section,
    input logic [10:0] in_strips_x,
    input logic [14:0] in_width,
    input logic [14:0] in_height,
    input logic signed [16:0] in_x,
    input logic signed [16:0] in_y,
    input logic in_extra_x,
    input logic in_extra_y,

    output logic out_valid,
    input logic out_ready,
    output logic [5:0] out_error,
    output logic [SIDE*SIDE*SAMPLE_BITS-1:0] out_window,

    output logic request_valid,
    input logic request_ready,
    output logic [ADDRESS_BITS-1:0] request_address,
    output logic [9:0] request_beats,
    input logic data_valid,
    input logic [DATA_BITS-1:0] data,
    input logic data_last,
    input logic data_error
);

  localparam int LINES = 64 / SAMPLES;
  localparam int LINES_LOG2 = $clog2(LINES);
  localparam int PLACES = STRIPS / 4;  // of a bank of tags
  localparam int PLACE_BITS = $clog2(PLACES);
  localparam int AREA_BITS = PLACE_BITS - SECTIONS;  // of luma's places in a section
  localparam int ROW_BITS = AREA_BITS / 2 + 1;       // by row
  localparam int COL_BITS = AREA_BITS - ROW_BITS;    // and by column
  localparam int TAG_BITS = ADDRESS_BITS - 4;
  localparam int STRIP_BEATS = 9;  // of 16 bytes, of a strip in the reference area
  localparam int LINE_BITS = 6 + SAMPLES * SAMPLE_BITS;

  // ---- 1, 2: blocks of the window.
  logic [2:1] valid;
  wire advance = lookup_ready;
  logic lookup_ready;
  assign in_ready = advance;
  logic [BLOCK_BITS-1:0] block_x, block_y;
  logic two_x, two_y;
  logic [SIDE*SELECT_BITS-1:0] select_x, select_y;
  hmlfc_reference_window #(
      .BLOCK_LOG2(BLOCK_LOG2)
  ) blocks (
      .clk,
      .advance,
      .x(in_x),
      .y(in_y),
      .extra_x(in_extra_x),
      .extra_y(in_extra_y),
      .width(in_width),
      .height(in_height),
      .block_x,
      .block_y,
      .two_x,
      .two_y,
      .select_x,
      .select_y
  );
  localparam int SIDE_INFO_BITS = ADDRESS_BITS + 2 + 1 + 11;
  logic [2*SIDE_INFO_BITS-1:0] infos;
  wire [ADDRESS_BITS-1:0] address_2 = infos[SIDE_INFO_BITS+14+:ADDRESS_BITS];
  wire [1:0] plane_2 = infos[SIDE_INFO_BITS+12+:2];
  wire section_2 = infos[SIDE_INFO_BITS+11];
  wire [10:0] strips_x_2 = infos[SIDE_INFO_BITS+:11];

  // ---- 3: strips. Index {row parity, column parity} counts banks of tags.
  wire [BLOCK_BITS-1:0] block_x_right = block_x + BLOCK_BITS'(two_x);
  wire [BLOCK_BITS-1:0] block_y_below = block_y + BLOCK_BITS'(two_y);
  wire [BLOCK_BITS-1:0] strip_left = block_x >> LINES_LOG2;
  wire [BLOCK_BITS-1:0] strip_right = block_x_right >> LINES_LOG2;
  logic valid_3;
  logic [3:0] needed_3;  // by bank
  logic [4*23-1:0] strips_3;
  logic [4*PLACE_BITS-1:0] places_3;
  logic [ADDRESS_BITS-1:0] address_3;
  logic [BLOCK_BITS-1:0] block_x_3, block_y_3;
  logic two_x_3, two_y_3;
  logic [SIDE*SELECT_BITS-1:0] select_x_3, select_y_3;

  // Where strip `column` of row `row` of a plane is kept in its bank.
  function automatic logic [PLACE_BITS-1:0] place_of(input logic section, input logic [1:0] plane,
                                                     input logic [BLOCK_BITS-1:0] row, input logic [BLOCK_BITS-1:0] column);
    logic [AREA_BITS-1:0] area;
    area = {row[ROW_BITS:1], column[COL_BITS:1]};
    if (plane != 2'd0) area[AREA_BITS-1] = plane[1];
    place_of = PLACE_BITS'({SECTIONS == 2 && section, plane != 2'd0, area});
  endfunction

  always_ff @(posedge clk) begin
    if (advance) begin
      valid <= {valid[1], in_valid};
      infos <= {infos[SIDE_INFO_BITS-1:0], in_address, in_plane, in_section, in_strips_x};
      valid_3 <= valid[2];
      address_3 <= address_2;
      block_x_3 <= block_x;
      block_y_3 <= block_y;
      two_x_3 <= two_x;
      two_y_3 <= two_y;
      select_x_3 <= select_x;
      select_y_3 <= select_y;
      needed_3 <= '0;
      for (int r = 0; r < 2; r++) begin
        for (int c = 0; c < 2; c++) begin
          logic [BLOCK_BITS-1:0] row, column;
          row = r == 0 ? block_y : block_y_below;
          column = c == 0 ? strip_left : strip_right;
          needed_3[{row[0], column[0]}] <= 1'b1;
          strips_3[32'({row[0], column[0]})*23+:23] <= 23'(row) * 23'(strips_x_2) + 23'(column);
          places_3[32'({row[0], column[0]})*PLACE_BITS+:PLACE_BITS] <= place_of(section_2, plane_2, row, column);
        end
      end
    end
    if (!rst_n) begin
      valid <= '0;
      valid_3 <= 1'b0;
    end
  end

  // ---- 4: tags. A window stays here until all its misses have been asked for.
  logic [TAG_BITS-1:0] tags[4*PLACES];
  logic [4*PLACES-1:0] kept;
  logic forget;
  logic [3:0] missing, asked;
  logic [4*TAG_BITS-1:0] wanted;
  always_comb begin
    for (int b = 0; b < 4; b++) begin
      logic [PLACE_BITS+1:0] at;
      at = {2'(b), places_3[b*PLACE_BITS+:PLACE_BITS]};
      wanted[b*TAG_BITS+:TAG_BITS] = TAG_BITS'(address_3 >> 4) + TAG_BITS'(strips_3[b*23+:23]) * TAG_BITS'(STRIP_BEATS);
      missing[b] = valid_3 && needed_3[b] && !asked[b] && !(kept[at] && tags[at] == wanted[b*TAG_BITS+:TAG_BITS]);
    end
  end
  logic [1:0] ask_bank;
  always_comb begin
    ask_bank = '0;
    for (int b = 3; b >= 0; b--) if (missing[b]) ask_bank = 2'(b);
  end
  wire any_missing = missing != 0;

  logic ask_ready;
  wire ask = any_missing && ask_ready;
  wire [2:0] asked_count = 3'(asked[0]) + 3'(asked[1]) + 3'(asked[2]) + 3'(asked[3]);
  logic queue_ready;
  wire enter = valid_3 && !any_missing && queue_ready;
  assign lookup_ready = !valid_3 || enter;
  wire [PLACE_BITS+1:0] ask_at = {ask_bank, places_3[32'(ask_bank)*PLACE_BITS+:PLACE_BITS]};
  always_ff @(posedge clk) begin
    if (ask) begin
      tags[ask_at] <= wanted[32'(ask_bank)*TAG_BITS+:TAG_BITS];
      kept[ask_at] <= 1'b1;
      asked[ask_bank] <= 1'b1;
    end
    if (enter || !rst_n) asked <= '0;
    if (!rst_n || flush || forget) kept <= '0;
  end

  // ---- 5: windows that wait for their strips.
  localparam int OP_BITS = 2 * BLOCK_BITS + 2 + 2 * SIDE * SELECT_BITS + 4 * PLACE_BITS + 3;
  logic op_valid, op_ready;
  logic [BLOCK_BITS-1:0] op_x, op_y;
  logic op_two_x, op_two_y;
  logic [SIDE*SELECT_BITS-1:0] op_select_x, op_select_y;
  logic [4*PLACE_BITS-1:0] op_places;
  logic [2:0] op_missed;  // strips that were asked for
  /* verilator lint_off PINCONNECTEMPTY */  // its count is not needed
  hmlfc_fifo #(
      .WIDTH(OP_BITS),
      .DEPTH(128)
  ) waiting (
      .clk,
      .rst_n,
      .in_valid(enter),
      .in_ready(queue_ready),
      .in_data({block_x_3, block_y_3, two_x_3, two_y_3, select_x_3, select_y_3, places_3, asked_count}),
      .out_valid(op_valid),
      .out_ready(op_ready),
      .out_data({op_x, op_y, op_two_x, op_two_y, op_select_x, op_select_y, op_places, op_missed}),
      .count()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  // ---- 6: the strips of the window in front are filled, then its lines are read.
  logic strip_valid, take;
  logic [PLACE_BITS+1:0] strip_place;
  logic [LINES*LINE_BITS-1:0] strip_lines;
  hmlfc_strip_fill #(
      .BLOCK_LOG2(BLOCK_LOG2),
      .SAMPLE_BITS(SAMPLE_BITS),
      .DATA_BITS(DATA_BITS),
      .PLACE_BITS(PLACE_BITS + 2)
  ) fill (
      .clk,
      .rst_n,
      .ask,
      .ask_ready,
      .ask_address({wanted[32'(ask_bank)*TAG_BITS+:TAG_BITS], 4'd0}),
      .ask_place(ask_at),
      .valid(strip_valid),
      .place(strip_place),
      .lines(strip_lines),
      .take,
      .request_valid,
      .request_ready,
      .request_address,
      .request_beats,
      .data_valid,
      .data,
      .data_last,
      .data_error
  );

  logic [2:0] filled;
  logic read_advance;
  wire complete = filled == op_missed;
  assign take = op_valid && !complete && strip_valid;
  assign op_ready = complete && read_advance;
  always_ff @(posedge clk) begin
    if (!rst_n || (op_valid && op_ready)) filled <= '0;
    else if (take) filled <= filled + 3'd1;
  end

  // Banks of lines: {parity of the row, line of the strip}, or with one line {row, strip} parity.
  localparam int COLUMNS = LINES > 1 ? LINES : 2;
  localparam int COLUMN_BITS = $clog2(COLUMNS);
  localparam int LINE_PLACE_BITS = LINES > 1 ? PLACE_BITS + 1 : PLACE_BITS;
  wire [COLUMN_BITS-1:0] left_column = op_x[COLUMN_BITS-1:0];
  wire left_parity = op_x[LINES_LOG2];
  logic [2*COLUMNS*LINE_BITS-1:0] bank_lines;
  for (genvar r = 0; r < 2; r++) begin : g_row
    wire [PLACE_BITS-1:0] even = op_places[(2*r)*PLACE_BITS+:PLACE_BITS];
    wire [PLACE_BITS-1:0] odd = op_places[(2*r+1)*PLACE_BITS+:PLACE_BITS];
    for (genvar c = 0; c < COLUMNS; c++) begin : g_column
      logic [LINE_BITS-1:0] memory[1<<LINE_PLACE_BITS];
      logic [LINE_PLACE_BITS-1:0] write_at, read_at;
      logic write;
      // The right block is in the next strip where its column is less than the left one's.
      logic parity;
      if (LINES > 1) begin : g_lines
        assign write = take && strip_place[PLACE_BITS+1] == 1'(r);
        assign write_at = {strip_place[PLACE_BITS], strip_place[PLACE_BITS-1:0]};
        /* verilator lint_off CMPCONST */  // always for the last column
        assign parity = COLUMN_BITS'(c) >= left_column ? left_parity : !left_parity;
        /* verilator lint_on CMPCONST */
        assign read_at = {parity, parity ? odd : even};
      end else begin : g_line
        assign write = take && strip_place[PLACE_BITS+1:PLACE_BITS] == {1'(r), 1'(c)};
        assign write_at = strip_place[PLACE_BITS-1:0];
        assign parity = 1'(c);
        assign read_at = parity ? odd : even;
      end
      always_ff @(posedge clk) begin
        if (write) memory[write_at] <= strip_lines[(LINES>1?c : 0)*LINE_BITS+:LINE_BITS];
        if (read_advance) bank_lines[(r*COLUMNS+c)*LINE_BITS+:LINE_BITS] <= memory[read_at];
      end
    end
  end

  // ---- 7: lines of the four blocks; 8: the window's samples.
  logic [8:6] read_valid;
  logic [COLUMN_BITS-1:0] column_6;
  logic row_6, two_x_6, two_y_6, two_x_7, two_y_7;
  logic [SIDE*SELECT_BITS-1:0] select_x_6, select_y_6, select_x_7, select_y_7;
  logic [4*LINE_BITS-1:0] blocks_7;  // {below, right}
  assign read_advance = !read_valid[8] || out_ready;

  // Samples in rows of both blocks: sample x of row y at 2B * y + x.
  localparam int B = 1 << BLOCK_LOG2;
  logic [4*SAMPLES*SAMPLE_BITS-1:0] area;
  always_comb begin
    for (int y = 0; y < 2 * B; y++) begin
      for (int x = 0; x < 2 * B; x++) begin
        area[(y*2*B+x)*SAMPLE_BITS+:SAMPLE_BITS] =
            blocks_7[((y/B)*2+(x/B))*LINE_BITS+((y%B)*B+x%B)*SAMPLE_BITS+:SAMPLE_BITS];
      end
    end
  end
  logic [SIDE*2*B*SAMPLE_BITS-1:0] selected_rows;
  always_comb begin
    for (int j = 0; j < SIDE; j++) begin
      selected_rows[j*2*B*SAMPLE_BITS+:2*B*SAMPLE_BITS] =
          area[32'(select_y_7[j*SELECT_BITS+:SELECT_BITS])*2*B*SAMPLE_BITS+:2*B*SAMPLE_BITS];
    end
  end
  wire [5:0] error_left = blocks_7[SAMPLES*SAMPLE_BITS+:6];
  wire [5:0] error_right = blocks_7[LINE_BITS+SAMPLES*SAMPLE_BITS+:6];
  wire [5:0] error_below = blocks_7[2*LINE_BITS+SAMPLES*SAMPLE_BITS+:6];
  wire [5:0] error_corner = blocks_7[3*LINE_BITS+SAMPLES*SAMPLE_BITS+:6];
  // The first in the order of DEC-7: blocks row by row.
  wire [5:0] error_7 = error_left != 0 ? error_left :
      two_x_7 && error_right != 0 ? error_right :
      two_y_7 && error_below != 0 ? error_below :
      two_x_7 && two_y_7 ? error_corner : 6'd0;

  always_ff @(posedge clk) begin
    if (read_advance) begin
      read_valid <= {read_valid[7:6], op_valid && complete};
      column_6 <= left_column;
      row_6 <= op_y[0];
      {two_x_6, two_y_6, select_x_6, select_y_6} <= {op_two_x, op_two_y, op_select_x, op_select_y};
      for (int r = 0; r < 2; r++) begin
        for (int c = 0; c < 2; c++) begin
          blocks_7[(r*2+c)*LINE_BITS+:LINE_BITS] <=
              bank_lines[(32'({row_6 ^ 1'(r)})*COLUMNS+32'(COLUMN_BITS'(column_6+COLUMN_BITS'(c))))*LINE_BITS+:LINE_BITS];
        end
      end
      {two_x_7, two_y_7, select_x_7, select_y_7} <= {two_x_6, two_y_6, select_x_6, select_y_6};
      out_error <= error_7;
      for (int j = 0; j < SIDE; j++) begin
        for (int i = 0; i < SIDE; i++) begin
          out_window[(j*SIDE+i)*SAMPLE_BITS+:SAMPLE_BITS] <=
              selected_rows[(j*2*B+32'(select_x_7[i*SELECT_BITS+:SELECT_BITS]))*SAMPLE_BITS+:SAMPLE_BITS];
        end
      end
    end
    if (!rst_n) read_valid <= '0;
  end
  assign out_valid = read_valid[8];
  // A strip that a bus error spoiled is not kept, whichever error its block is answered with.
  wire spoiled = error_left == HMLFC_ERROR_BUS_ERROR || (two_x_7 && error_right == HMLFC_ERROR_BUS_ERROR) ||
      (two_y_7 && (error_below == HMLFC_ERROR_BUS_ERROR || (two_x_7 && error_corner == HMLFC_ERROR_BUS_ERROR)));
  assign forget = read_valid[7] && read_advance && spoiled;

endmodule
