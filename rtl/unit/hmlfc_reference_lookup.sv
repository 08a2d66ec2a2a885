// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Finds which strips a window of reference samples needs and asks for those that are not kept.
//
// Windows enter in order (`in_*`) and leave in the same order (`out_*`), one a clock where at most one strip is missing:
// all strips that a window misses are requested, one a clock (`ask`), and it leaves with the last. From then on they
// count as kept. Latency 6 clocks.
//
// BLOCK_LOG2   [1, 3], B = 2^BLOCK_LOG2
// STRIPS       kept; a power of two, at least 64 * SECTIONS
// SECTIONS     1, 2
//
// Tags lie in four banks by the parity of a strip's row and column, so that the at most 2 x 2 strips of a window are
// looked up in one clock. A strip has one place, by its row, its column and the plane's address: luma uses half of the
// places, each chroma plane a quarter; with SECTIONS = 2 `in_section` chooses the half of the cache. `forget` forgets
// all strips; so does `flush`.
//
// out_places   of the four strips in their banks {row parity, column parity}; those that the window does not need do
// not matter
// out_missed   strips that were requested, [0, 4]
// ask_place    {bank, place in it}
module hmlfc_reference_lookup #(
    parameter int BLOCK_LOG2 = 2,
    parameter int STRIPS = 512,
    parameter int SECTIONS = 1,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS,
    localparam int SIDE = (1 << BLOCK_LOG2) + 1,
    localparam int SELECT_BITS = BLOCK_LOG2 + 1,
    localparam int PLACES = STRIPS / 4,  // of a bank of tags
    localparam int PLACE_BITS = $clog2(PLACES)
) (
    input logic clk,
    input logic rst_n,
    input logic flush,
    input logic forget,

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

    output logic ask,
    input logic ask_ready,
    output logic [ADDRESS_BITS-1:0] ask_address,
    output logic [PLACE_BITS+1:0] ask_place,

    output logic out_valid,
    input logic out_ready,
    output logic [BLOCK_BITS-1:0] out_block_x,
    output logic [BLOCK_BITS-1:0] out_block_y,
    output logic out_two_x,
    output logic out_two_y,
    output logic [SIDE*SELECT_BITS-1:0] out_select_x,
    output logic [SIDE*SELECT_BITS-1:0] out_select_y,
    output logic [4*PLACE_BITS-1:0] out_places,
    output logic [2:0] out_missed
);

  localparam int LINES_LOG2 = $clog2(64 / (1 << (2 * BLOCK_LOG2)));  // blocks of a strip
  localparam int AREA_BITS = PLACE_BITS - SECTIONS;  // of luma's places in a section
  localparam int ROW_BITS = AREA_BITS / 2 + 1;       // by row
  localparam int COL_BITS = AREA_BITS - ROW_BITS;    // and by column
  localparam int STRIP_LOG2 = $clog2(hmlfc_pkg::STRIP_BYTES);
  localparam int TAG_BITS = ADDRESS_BITS - STRIP_LOG2;

  // ---- 1, 2: blocks of the window.
  logic [6:1] valid;
  logic enter;  // the window at its lookup leaves it
  wire advance = !valid[6] || enter;
  assign in_ready = advance;
  logic [BLOCK_BITS-1:0] block_x, block_y;
  logic two_x, two_y;
  logic [SIDE*SELECT_BITS-1:0] select_x, select_y;
  hmlfc_window_axis #(.BLOCK_LOG2(BLOCK_LOG2)) columns (
      .clk, .advance, .at(in_x), .size(in_width), .extra(in_extra_x), .block(block_x), .two(two_x), .select(select_x)
  );
  hmlfc_window_axis #(.BLOCK_LOG2(BLOCK_LOG2)) rows (
      .clk, .advance, .at(in_y), .size(in_height), .extra(in_extra_y), .block(block_y), .two(two_y), .select(select_y)
  );
  localparam int SIDE_INFO_BITS = TAG_BITS + 2 + 1 + 11;
  logic [2*SIDE_INFO_BITS-1:0] infos;
  wire [TAG_BITS-1:0] address_2 = infos[SIDE_INFO_BITS+14+:TAG_BITS];  // in units of strips, as tags are
  wire [1:0] plane_2 = infos[SIDE_INFO_BITS+12+:2];
  wire section_2 = infos[SIDE_INFO_BITS+11];
  wire [10:0] strips_x_2 = infos[SIDE_INFO_BITS+:11];

  // ---- 3 to 5: strips and their addresses. Banks of tags count {row parity, column parity}: of two rows (columns)
  // that follow each other one is even, one is odd.
  wire [BLOCK_BITS-1:0] strip_left = block_x >> LINES_LOG2;
  wire [BLOCK_BITS-1:0] strip_right = (block_x + BLOCK_BITS'(two_x)) >> LINES_LOG2;
  wire [2*BLOCK_BITS-1:0] rows_2 = {block_y | BLOCK_BITS'(1), block_y + BLOCK_BITS'(block_y[0])};  // {odd, even}
  wire [2*BLOCK_BITS-1:0] columns_2 = {strip_left | BLOCK_BITS'(1), strip_left + BLOCK_BITS'(strip_left[0])};
  wire [1:0] rows_needed_2 = two_y ? 2'b11 : block_y[0] ? 2'b10 : 2'b01;
  wire [1:0] columns_needed_2 = strip_left != strip_right ? 2'b11 : strip_left[0] ? 2'b10 : 2'b01;

  // Changes the place by the plane's address: a request reads near the same row and column in the reference images of
  // all its levels, and these would replace each other.
  function automatic logic [1:0] order_of(input logic [TAG_BITS-1:0] address);
    order_of = '0;  // an image has 3 * 2^k strips where its sides are powers of two: groups of two bits would not tell
    for (int i = 0; i < TAG_BITS; i++) begin
      if (i % 3 != 2) order_of[0] = order_of[0] ^ address[i];
      if (i % 3 != 1) order_of[1] = order_of[1] ^ address[i];
    end
  endfunction

  // Where strip `column` of row `row` of a plane is kept in its bank.
  function automatic logic [PLACE_BITS-1:0] place_of(input logic section, input logic [1:0] plane,
      input logic [1:0] order, input logic [BLOCK_BITS-1:0] row, input logic [BLOCK_BITS-1:0] column);
    logic [AREA_BITS-1:0] area;
    area = {row[ROW_BITS:1], column[COL_BITS:1]};
    area[COL_BITS+ROW_BITS-2] = area[COL_BITS+ROW_BITS-2] ^ order[0];
    area[COL_BITS-1] = area[COL_BITS-1] ^ order[1];
    if (plane != 2'd0) area[AREA_BITS-1] = plane[1];
    place_of = PLACE_BITS'({SECTIONS == 2 && section, plane != 2'd0, area});
  endfunction

  // What goes along: {block_x, block_y, two_x, two_y, select_x, select_y, places}.
  localparam int READ_BITS = 2 * BLOCK_BITS + 2 + 2 * SIDE * SELECT_BITS + 4 * PLACE_BITS;
  logic [4*PLACE_BITS-1:0] places_2;
  for (genvar b = 0; b < 4; b++) begin : g_place
    assign places_2[b*PLACE_BITS+:PLACE_BITS] =
        place_of(section_2, plane_2, order_of(address_2), rows_2[(b/2)*BLOCK_BITS+:BLOCK_BITS],
                 columns_2[(b%2)*BLOCK_BITS+:BLOCK_BITS]);
  end
  logic [READ_BITS-1:0] read_3, read_4, read_5, read_6;
  wire [4*PLACE_BITS-1:0] places_5 = read_5[4*PLACE_BITS-1:0];
  wire [4*PLACE_BITS-1:0] places_6 = read_6[4*PLACE_BITS-1:0];
  logic [1:0] rows_needed_3, columns_needed_3;
  logic [3:0] needed_4, needed_5, needed_6;
  logic [TAG_BITS-1:0] address_3;
  logic [2*23-1:0] rows_3;                  // first strips of the rows: row * strips_x
  logic [2*BLOCK_BITS-1:0] columns_3, columns_4;
  logic [2*TAG_BITS-1:0] rows_4;            // their addresses
  logic [4*TAG_BITS-1:0] wanted_5, wanted;  // addresses of the strips
  always_ff @(posedge clk) begin
    if (advance) begin
      valid <= {valid[5:1], in_valid};
      infos <= {infos[SIDE_INFO_BITS-1:0], in_address[ADDRESS_BITS-1:STRIP_LOG2], in_plane, in_section, in_strips_x};
      read_3 <= {block_x, block_y, two_x, two_y, select_x, select_y, places_2};
      {read_6, read_5, read_4} <= {read_5, read_4, read_3};
      address_3 <= address_2;
      {rows_needed_3, columns_needed_3} <= {rows_needed_2, columns_needed_2};
      {columns_4, columns_3} <= {columns_3, columns_2};
      needed_4 <= {{2{rows_needed_3[1]}} & columns_needed_3, {2{rows_needed_3[0]}} & columns_needed_3};
      {needed_6, needed_5} <= {needed_5, needed_4};
      for (int k = 0; k < 2; k++) begin
        rows_3[k*23+:23] <= 23'(rows_2[k*BLOCK_BITS+:BLOCK_BITS]) * 23'(strips_x_2);
        rows_4[k*TAG_BITS+:TAG_BITS] <= address_3 + TAG_BITS'(rows_3[k*23+:23]);
      end
      for (int b = 0; b < 4; b++) begin
        wanted_5[b*TAG_BITS+:TAG_BITS] <=
            rows_4[(b/2)*TAG_BITS+:TAG_BITS] + TAG_BITS'(columns_4[(b%2)*BLOCK_BITS+:BLOCK_BITS]);
      end
      wanted <= wanted_5;
    end
    if (!rst_n) valid <= '0;
  end

  // ---- 6: tags, read when a window comes to its lookup. The window before may write one in the same clock: then it is
  // known whether that is the tag that this one wants.
  logic [4*PLACES-1:0] kept;
  logic [3:0] missing, asked;
  logic [1:0] ask_bank;
  logic [PLACE_BITS-1:0] ask_in_bank;
  logic [TAG_BITS-1:0] ask_tag;
  for (genvar b = 0; b < 4; b++) begin : g_tags
    logic [TAG_BITS-1:0] tag;
    logic late, same;
    wire [PLACE_BITS-1:0] place = places_6[b*PLACE_BITS+:PLACE_BITS];
    wire [TAG_BITS-1:0] own = wanted[b*TAG_BITS+:TAG_BITS];
    hmlfc_ram #(.WIDTH(TAG_BITS), .DEPTH(PLACES)) tags (
        .clk, .write(ask && ask_bank == 2'(b)), .write_address(place), .write_data(own), .read(advance),
        .read_address(places_5[b*PLACE_BITS+:PLACE_BITS]), .read_data(tag)
    );
    always_ff @(posedge clk) begin
      if (advance) begin
        late <= ask && ask_bank == 2'(b) && places_5[b*PLACE_BITS+:PLACE_BITS] == place;
        same <= wanted_5[b*TAG_BITS+:TAG_BITS] == own;
      end
    end
    assign missing[b] = valid[6] && needed_6[b] && !asked[b] &&
        !(kept[b*PLACES+32'(place)] && (late ? same : tag == own));
  end
  always_comb begin
    ask_bank = '0;
    ask_in_bank = '0;
    ask_tag = '0;
    for (int b = 3; b >= 0; b--) begin
      if (missing[b]) begin
        ask_bank = 2'(b);
        ask_in_bank = places_6[b*PLACE_BITS+:PLACE_BITS];
        ask_tag = wanted[b*TAG_BITS+:TAG_BITS];
      end
    end
  end
  wire any_missing = missing != 0;
  assign ask = any_missing && ask_ready;
  assign ask_address = {ask_tag, STRIP_LOG2'(0)};
  assign ask_place = {ask_bank, ask_in_bank};
  wire last_missing = (missing & (missing - 4'd1)) == 0;
  assign out_valid = valid[6] && (!any_missing || (last_missing && ask_ready));
  assign enter = out_valid && out_ready;
  assign {out_block_x, out_block_y, out_two_x, out_two_y, out_select_x, out_select_y, out_places} = read_6;
  assign out_missed = 3'(asked[0]) + 3'(asked[1]) + 3'(asked[2]) + 3'(asked[3]) + 3'(any_missing);
  always_ff @(posedge clk) begin
    if (ask) begin
      kept[ask_place] <= 1'b1;
      asked[ask_bank] <= 1'b1;
    end
    if (enter || !rst_n) asked <= '0;
    if (!rst_n || flush || forget) kept <= '0;
  end

endmodule

`default_nettype wire
