// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Fetches the samples of one reference of each block, through a cache of strips.
//
// Takes windows in order (`in_*`) and gives their samples in the same order, one window a clock while the
// cache hits. Tags are looked up when a window enters, and misses are requested at once; the window
// then waits in a queue until its strips have come. So the latency of the memory is hidden as
// long as the queue is not full. Strips are filled in the order in which they were requested, each when its
// window is the next to be read.
//
// hmlfc_reference_lookup has the tags, hmlfc_strip_fill fetches strips, hmlfc_reference_lines has their samples.
module hmlfc_reference_cache #(
    parameter int BLOCK_LOG2 = 2,
    parameter int SAMPLE_BITS = 10,
    parameter int DATA_BITS = 128,
    parameter int STRIPS = 512,  // kept; a power of two, at least 64 * SECTIONS
    parameter int SECTIONS = 1,  // 1, 2
    parameter int FILLS = 32,  // strips in flight, a power of two
    parameter int STRIP_READ = 32,  // bytes of a strip that are read at once: 32, 64
    parameter int CLOCKS = 1,  // of a window, which comes in parts as hmlfc_reference_lines says
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS,
    localparam int SIDE = (1 << BLOCK_LOG2) + 1,
    localparam int ROWS = (1 << BLOCK_LOG2) / CLOCKS + 1,  // of a part
    localparam int SELECT_BITS = BLOCK_LOG2 + 1
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
    output logic [ROWS*SIDE*SAMPLE_BITS-1:0] out_window,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  localparam int PLACE_BITS = $clog2(STRIPS / 4);
  localparam int LINES_BITS = (64 >> (2 * BLOCK_LOG2)) * 6 + 64 * SAMPLE_BITS;  // of a strip

  // ---- Lookup: a window is ready to wait when its misses have been requested.
  logic forget, ask, ask_ready, found_valid, found_ready, found_two_x, found_two_y;
  logic [ADDRESS_BITS-1:0] ask_address;
  logic [PLACE_BITS+1:0] ask_place;
  logic [BLOCK_BITS-1:0] found_x, found_y;
  logic [SIDE*SELECT_BITS-1:0] found_select_x, found_select_y;
  logic [4*PLACE_BITS-1:0] found_places;
  logic [2:0] found_missed;
  hmlfc_reference_lookup #(.BLOCK_LOG2(BLOCK_LOG2), .STRIPS(STRIPS), .SECTIONS(SECTIONS)) lookup (
      .clk, .rst_n, .flush, .forget, .in_valid, .in_ready, .in_address, .in_plane, .in_section, .in_strips_x, .in_width,
      .in_height, .in_x, .in_y, .in_extra_x, .in_extra_y, .ask, .ask_ready, .ask_address, .ask_place,
      .out_valid(found_valid), .out_ready(found_ready), .out_block_x(found_x), .out_block_y(found_y),
      .out_two_x(found_two_x), .out_two_y(found_two_y), .out_select_x(found_select_x), .out_select_y(found_select_y),
      .out_places(found_places), .out_missed(found_missed)
  );

  // ---- Windows that wait for their strips.
  localparam int READ_BITS = 2 * BLOCK_BITS + 2 + 2 * SIDE * SELECT_BITS + 4 * PLACE_BITS;
  logic op_valid, op_ready;
  logic [READ_BITS-1:0] op;
  logic [2:0] op_missed;
  hmlfc_fifo #(.WIDTH(READ_BITS + 3), .DEPTH(256), .BYPASS(CLOCKS == 1)) waiting (
      .clk, .rst_n, .in_valid(found_valid), .in_ready(found_ready),
      .in_data({
        found_x, found_y, found_two_x, found_two_y, found_select_x, found_select_y, found_places, found_missed
      }),
      .out_valid(op_valid), .out_ready(op_ready), .out_data({op, op_missed}), .count()
  );

  // ---- The strips of the window in front are filled, then its lines are read.
  logic strip_valid, take;
  logic [PLACE_BITS+1:0] strip_place;
  logic [LINES_BITS-1:0] strip_lines;
  hmlfc_strip_fill #(
      .BLOCK_LOG2(BLOCK_LOG2), .SAMPLE_BITS(SAMPLE_BITS), .DATA_BITS(DATA_BITS), .PLACE_BITS(PLACE_BITS + 2),
      .SLOTS(FILLS), .FIRST_BYTES(STRIP_READ), .UNPACKERS(DATA_BITS == 256 ? 2 : 1)
  ) fill (
      .clk, .rst_n, .ask, .ask_ready, .ask_address, .ask_place, .valid(strip_valid), .place(strip_place),
      .lines(strip_lines), .take, .request, .response, .data
  );

  // A strip is written while the window before is read, unless it replaces one of that window.
  logic reading, lines_ready;
  logic [READ_BITS-1:0] read;
  wire [4*PLACE_BITS-1:0] read_places = read[4*PLACE_BITS-1:0];
  logic [3:0] same_place;  // by bank
  for (genvar b = 0; b < 4; b++) begin : g_same
    assign same_place[b] = read_places[b*PLACE_BITS+:PLACE_BITS] == strip_place[PLACE_BITS-1:0];
  end
  wire replaces = reading && same_place[strip_place[PLACE_BITS+:2]];
  logic [2:0] filled;
  wire complete = filled == op_missed;
  localparam bit HALVES = CLOCKS > 1 && BLOCK_LOG2 < 3;  // a strip is written by halves of its lines
  logic half;
  wire write = op_valid && !complete && strip_valid && !replaces;
  assign take = write && half == HALVES;
  wire move = op_valid && op_ready;
  assign op_ready = (complete || (take && filled + 3'd1 == op_missed)) && (!reading || lines_ready);
  always_ff @(posedge clk) begin
    if (!rst_n || move) filled <= '0;
    else if (take) filled <= filled + 3'd1;
    half <= rst_n && HALVES && write && !half;
    reading <= rst_n && (move || (reading && !lines_ready));
    if (move) read <= op;
  end

  // ---- Samples. A strip that a bus error spoiled is not kept, whichever error its block is answered with.
  logic [BLOCK_BITS-1:0] read_x, read_y;
  logic read_two_x, read_two_y;
  logic [SIDE*SELECT_BITS-1:0] read_select_x, read_select_y;
  assign {read_x, read_y, read_two_x, read_two_y, read_select_x, read_select_y} = read[READ_BITS-1:4*PLACE_BITS];
  logic window_valid, window_ready;
  logic [5:0] window_error;
  logic [ROWS*SIDE*SAMPLE_BITS-1:0] window;
  hmlfc_reference_lines #(
      .BLOCK_LOG2(BLOCK_LOG2), .SAMPLE_BITS(SAMPLE_BITS), .PLACE_BITS(PLACE_BITS), .CLOCKS(CLOCKS)
  ) lines (
      .clk, .rst_n, .write, .write_half(half), .write_place(strip_place), .write_lines(strip_lines),
      .in_valid(reading), .in_ready(lines_ready), .in_block_x(read_x), .in_block_y(read_y), .in_two_x(read_two_x),
      .in_two_y(read_two_y), .in_select_x(read_select_x), .in_select_y(read_select_y), .in_places(read_places),
      .out_valid(window_valid), .out_ready(window_ready), .out_error(window_error), .out_window(window), .spoiled(forget)
  );
  // Whether the window is taken is known late in a clock.
  hmlfc_skid_buffer #(.WIDTH(6 + ROWS * SIDE * SAMPLE_BITS)) windows (
      .clk, .rst_n, .in_valid(window_valid), .in_ready(window_ready), .in_data({window_error, window}), .out_valid,
      .out_ready, .out_data({out_error, out_window})
  );

endmodule

`default_nettype wire
