// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// From answers and their places to lines of memory (64 bytes) with strobes.
//
// Each row of a quad has a line in which the bytes of its blocks come together; a line leaves when bytes of another
// come, and all leave with `flush`, which says that no place will come. `empty`: nothing is held. A tile's errors go to
// the bitmap when the last of its places is taken, or with `flush`. `block_error` is high for one clock for a block
// that has the error `error`.
module hmlfc_view_writer #(
    parameter int BLOCK_LOG2 = 2,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int ANSWER_BITS = 3 * 16 << (2 * BLOCK_LOG2)
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::view_t view,
    input logic flush,
    output logic empty,
    output logic block_error,
    output logic [5:0] error,

    input logic place_valid,
    output logic place_ready,
    input hmlfc_pkg::place_t place,
    input logic answer_valid,
    output logic answer_ready,
    input logic [ANSWER_BITS-1:0] answer,
    input logic [5:0] answer_status,

    output logic line_valid,
    input logic line_ready,
    output logic [ADDRESS_BITS-7:0] line,
    output logic [511:0] line_data,
    output logic [63:0] line_strobe
);

  localparam int ENTRIES = 2 << BLOCK_LOG2;  // rows of a quad

  // ---- A place and, where it has a block, the answer.
  logic rows_ready, word_waits;
  wire usable = place_valid && !flush && !word_waits;
  wire take = usable && (!place.has_block || (answer_valid && rows_ready));
  wire take_block = take && place.has_block;
  assign place_ready = take;
  assign answer_ready = take_block;

  logic row_valid, row_ready, row_wraps, rows_empty;
  logic [BLOCK_LOG2:0] row_entry;
  logic [ADDRESS_BITS-7:0] row_line, row_line_next;
  logic [511:0] row_data;
  logic [63:0] row_strobe, row_strobe_next;
  hmlfc_view_rows #(.BLOCK_LOG2(BLOCK_LOG2)) rows (
      .clk, .rst_n, .format(view.format), .pitch(view.pitch), .in_valid(usable && place.has_block && answer_valid),
      .in_ready(rows_ready), .in_samples(answer), .in_status(answer_status), .in_end_column(place.end_column),
      .in_end_row(place.end_row), .in_lower(place.tile_y[0]), .in_address(place.address), .error,
      .out_valid(row_valid), .out_ready(row_ready), .out_entry(row_entry), .out_line(row_line),
      .out_line_next(row_line_next), .out_data(row_data), .out_strobe(row_strobe), .out_strobe_next(row_strobe_next),
      .out_wraps(row_wraps), .empty(rows_empty)
  );
  assign block_error = take_block && error != 0;

  // ---- The bitmap's word of a tile.
  logic [63:0] word;
  logic word_held, word_ended, word_ready;
  logic [21:0] word_tile;
  logic [ADDRESS_BITS-4:0] word_place;
  assign word_waits = word_held && word_ended;
  wire word_valid = word_held && (word_ended || flush);
  always_ff @(posedge clk) begin
    word_place <= view.bitmap[ADDRESS_BITS-1:3] + (ADDRESS_BITS - 3)'(word_tile);
    if (take_block) word_tile <= place.tile;
    if (!rst_n || (word_valid && word_ready)) begin
      word <= '0;
      word_held <= 1'b0;
      word_ended <= 1'b0;
    end else if (take) begin
      if (place.has_block) word_held <= view.bitmap != 0;
      if (place.has_block && view.bitmap != 0) word[{place.tile_y, place.tile_x}] <= error != 0;
      word_ended <= place.tile_ends;
    end else if (word_ended) begin
      word_ended <= word_held;
    end
  end

  // ---- Lines of the rows of a quad.
  logic second;  // the row's bytes of its first line are done
  logic [511:0] lines[0:ENTRIES-1];
  logic [ADDRESS_BITS-7:0] numbers[0:ENTRIES-1];
  logic [63:0] strobes[0:ENTRIES-1];
  logic [ENTRIES-1:0] held;
  logic [BLOCK_LOG2:0] flushed;  // the entry that leaves next with `flush`
  wire [63:0] put_strobe = second ? row_strobe_next : row_strobe;
  wire [ADDRESS_BITS-7:0] put_line = second ? row_line_next : row_line;
  wire all_leave = flush && rows_empty;
  wire [BLOCK_LOG2:0] entry = all_leave ? flushed : row_entry;
  wire same = held[row_entry] && numbers[row_entry] == put_line;
  wire leaves = held[entry] && (all_leave || (row_valid && !same));

  // The word's address is known a clock after its tile.
  logic word_placed;
  always_ff @(posedge clk) word_placed <= word_valid && !(word_valid && word_ready);
  wire word_first = word_valid && word_placed;
  assign word_ready = word_first && line_ready;
  wire leave = leaves && !word_first && line_ready;
  wire put = row_valid && (!held[row_entry] || same || leave);
  assign row_ready = put && (second || !row_wraps);

  assign line_valid = word_first || leaves;
  assign line = word_first ? word_place[ADDRESS_BITS-4:3] : numbers[entry];
  assign line_data = word_first ? {8{word}} : lines[entry];
  assign line_strobe = word_first ? 64'hff << {word_place[2:0], 3'd0} : strobes[entry];

  always_ff @(posedge clk) begin
    for (int i = 0; i < 64; i++) begin
      if (put && put_strobe[i]) lines[row_entry][8*i+:8] <= row_data[8*i+:8];
    end
    if (put) begin
      numbers[row_entry] <= put_line;
      strobes[row_entry] <= put_strobe | (same ? strobes[row_entry] : 64'd0);
    end
    if (!rst_n) held <= '0;
    else if (put) held[row_entry] <= 1'b1;
    else if (leave) held[entry] <= 1'b0;
    if (!rst_n) second <= 1'b0;
    else if (put) second <= row_wraps && !second;
    if (!rst_n || !flush) flushed <= '0;
    else if (all_leave && (leave || !held[flushed])) flushed <= flushed + 1'b1;
  end
  assign empty = rows_empty && held == 0 && !word_held;

endmodule

`default_nettype wire
