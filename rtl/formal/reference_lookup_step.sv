// A step from any state: of the window that reference_window describes, the row and the strip of each parity, which of them it needs, and their
// addresses (docs/decode_unit.md, The reference area) and places, stage by stage; at the lookup, the lowest bank that it needs and that has not the
// strip is asked for, its tag written, and it counts as kept until all are forgotten; a window leaves when none is missing.
// The window may be anything, the tags that are read, too. BLOCK_LOG2 = 2, STRIPS = 64, SECTIONS = 1.
//
// Clauses: none: the reference area (docs/decode_unit.md)
// Engine: bmc 2
// Memories: arrays
// Complete: any step.
// Fault: hmlfc_reference_lookup.sv / rows_needed_2 = two_y ? 2'b11 / rows_needed_2 = two_x ? 2'b11
// Fault: hmlfc_reference_lookup.sv / TAG_BITS'(STRIP_BEATS) / TAG_BITS'(8)
// Fault: hmlfc_reference_lookup.sv / strip_left != strip_right ? 2'b11 / two_x ? 2'b11
// Fault: hmlfc_reference_lookup.sv / area[AREA_BITS-1] = plane[1] / area[AREA_BITS-1] = plane[0]
// Fault: hmlfc_reference_lookup.sv / .write_address(place) / .write_address(places_5[b*PLACE_BITS+:PLACE_BITS])
// Fault: hmlfc_reference_lookup.sv / if (enter || !rst_n) asked <= '0 / if (!rst_n) asked <= '0

// In the place of reference_window: what it is given, and any outputs.
module hmlfc_reference_window #(parameter integer BLOCK_LOG2 = 0) (
  input logic clk, input logic advance, input logic [16:0] x, input logic [16:0] y, input logic extra_x, input logic extra_y, input logic [14:0] width,
  input logic [14:0] height, output logic [12:0] block_x, output logic [12:0] block_y, output logic two_x, output logic two_y,
  output logic [14:0] select_x, output logic [14:0] select_y);
  (* anyseq *) logic [57:0] any;
  assign {block_x, block_y, two_x, two_y, select_x, select_y} = any;
  wire [66:0] given = {advance, x, y, extra_x, extra_y, width, height};
endmodule

module prove_reference_lookup_step #(
  parameter integer STRIPS = 64,
  parameter integer SECTIONS = 1
) (
  input logic clk, input logic rst_n, input logic flush, input logic forget, input logic in_valid, input logic [39:0] in_address,
  input logic [1:0] in_plane, input logic in_section, input logic [10:0] in_strips_x, input logic [14:0] in_width, input logic [14:0] in_height,
  input logic [16:0] in_x, input logic [16:0] in_y, input logic in_extra_x, input logic in_extra_y, input logic ask_ready, input logic out_ready
);
  localparam integer K = $clog2(STRIPS);  // bits of a place with its bank
  localparam integer P = K - 2;           // and without
  localparam integer R = 58 + 4 * P;      // of what goes along
  logic         in_ready, ask, out_valid, out_two_x, out_two_y;
  logic [39:0]  ask_address;
  logic [K-1:0] ask_place;
  logic [12:0]  out_block_x, out_block_y;
  logic [14:0]  out_select_x, out_select_y;
  logic [4*P-1:0] out_places;
  logic [2:0]   out_missed;
  hmlfc_reference_lookup #(.BLOCK_LOG2(2), .STRIPS(STRIPS), .SECTIONS(SECTIONS)) dut (
    .clk(clk), .rst_n(rst_n), .flush(flush), .forget(forget), .in_valid(in_valid), .in_ready(in_ready), .in_address(in_address), .in_plane(in_plane),
    .in_section(in_section), .in_strips_x(in_strips_x), .in_width(in_width), .in_height(in_height), .in_x(in_x), .in_y(in_y), .in_extra_x(in_extra_x),
    .in_extra_y(in_extra_y), .ask(ask), .ask_ready(ask_ready), .ask_address(ask_address), .ask_place(ask_place), .out_valid(out_valid),
    .out_ready(out_ready), .out_block_x(out_block_x), .out_block_y(out_block_y), .out_two_x(out_two_x), .out_two_y(out_two_y),
    .out_select_x(out_select_x), .out_select_y(out_select_y), .out_places(out_places), .out_missed(out_missed));

  // Stages. Of two rows, and two columns of strips, the even one comes first; banks are {row, column}.
  (* hierconn *) wire [66:0]   \dut.blocks.given ;
  (* hierconn *) wire [57:0]   \dut.blocks.any ;
  (* hierconn *) wire [6:1]    \dut.valid ;
  (* hierconn *) wire [99:0]   \dut.infos ;  // {address, plane, section, strips_x}, the older one above
  (* hierconn *) wire [25:0]   \dut.rows_2 , \dut.columns_3 ;
  (* hierconn *) wire [R-1:0]  \dut.read_3 , \dut.read_4 , \dut.read_5 , \dut.read_6 ;
  (* hierconn *) wire [1:0]    \dut.rows_needed_3 , \dut.columns_needed_3 ;
  (* hierconn *) wire [3:0]    \dut.needed_4 , \dut.needed_5 , \dut.needed_6 ;
  (* hierconn *) wire [35:0]   \dut.address_3 ;
  (* hierconn *) wire [45:0]   \dut.rows_3 ;
  (* hierconn *) wire [71:0]   \dut.rows_4 ;
  (* hierconn *) wire [33:0]   \dut.columns_4 ;
  (* hierconn *) wire [143:0]  \dut.wanted_5 , \dut.wanted ;
  (* hierconn *) wire [STRIPS-1:0] \dut.kept ;
  (* hierconn *) wire [3:0]    \dut.asked ;
  wire [3:0]     writes, reads;
  wire [4*P-1:0] write_at, read_at;
  wire [143:0]   written, tags;
`define TAGS(b, c, d, e, f, g, h) \
  (* hierconn *) wire c , d ; (* hierconn *) wire [P-1:0] e , f ; (* hierconn *) wire [35:0] g , h ; \
  assign {writes[b], reads[b], write_at[b*P+:P], read_at[b*P+:P], written[b*36+:36], tags[b*36+:36]} = {c , d , e , f , g , h };
  `TAGS(0, \dut.g_tags[0].tags.write , \dut.g_tags[0].tags.read , \dut.g_tags[0].tags.write_address , \dut.g_tags[0].tags.read_address ,
        \dut.g_tags[0].tags.write_data , \dut.g_tags[0].tags.read_data )
  `TAGS(1, \dut.g_tags[1].tags.write , \dut.g_tags[1].tags.read , \dut.g_tags[1].tags.write_address , \dut.g_tags[1].tags.read_address ,
        \dut.g_tags[1].tags.write_data , \dut.g_tags[1].tags.read_data )
  `TAGS(2, \dut.g_tags[2].tags.write , \dut.g_tags[2].tags.read , \dut.g_tags[2].tags.write_address , \dut.g_tags[2].tags.read_address ,
        \dut.g_tags[2].tags.write_data , \dut.g_tags[2].tags.read_data )
  `TAGS(3, \dut.g_tags[3].tags.write , \dut.g_tags[3].tags.read , \dut.g_tags[3].tags.write_address , \dut.g_tags[3].tags.read_address ,
        \dut.g_tags[3].tags.write_data , \dut.g_tags[3].tags.read_data )

  // The window at stage 2: its strips, each with its place.
  wire [12:0] block_x = \dut.blocks.any [57:45], block_y = \dut.blocks.any [44:32];
  wire        two_x = \dut.blocks.any [31], two_y = \dut.blocks.any [30];
  wire [35:0] address = \dut.infos [99:64];
  wire [1:0]  plane = \dut.infos [63:62];
  wire        section = \dut.infos [61];
  wire [10:0] strips_x = \dut.infos [60:50];
  wire [12:0] left = block_x / 4;
  wire [12:0] right = 13'(block_x + 13'(two_x)) / 4;
  logic [25:0] rows, columns;
  logic [1:0]  rows_needed, columns_needed;
  logic [4*P-1:0] places;
  always @* begin
    for (integer p = 0; p < 2; p = p + 1) begin
      rows[13*p +: 13] = block_y[0] == p ? block_y : block_y + 13'd1;
      columns[13*p +: 13] = left[0] == p ? left : left + 13'd1;
      rows_needed[p] = block_y[0] == p || two_y;
      columns_needed[p] = left[0] == p || right[0] == p;
    end
    // The lowest bits of row and column behind the parity, changed by the address; instead of the next one of the row, the plane of chroma.
    for (integer b = 0; b < 4; b = b + 1)
      places[P*b +: P] = P'({SECTIONS == 2 && section, plane != 0, plane != 0 ? plane[1] : rows[b/2*13 + 2], rows[b/2*13 + 1] ^ (^(address & 36'h555555555)),
                             columns[b%2*13 + 1] ^ (^(address & 36'haaaaaaaaa))});
  end

  // The window at its lookup.
  logic [3:0] missing;
  logic [1:0] bank;
  always @* begin
    bank = 2'd0;
    for (integer b = 3; b >= 0; b = b - 1) begin
      missing[b] = \dut.valid [6] && \dut.needed_6 [b] && !\dut.asked [b] &&
                   !(\dut.kept [{2'(b), out_places[P*b +: P]}] && tags[36*b +: 36] == \dut.wanted [36*b +: 36]);
      if (missing[b]) bank = 2'(b);
    end
  end
  wire asks = missing != 0 && ask_ready;
  wire leaves = \dut.valid [6] && missing == 0 && out_ready;
  wire moves = !\dut.valid [6] || leaves;

  (* anyconst *) logic [K-1:0] any;  // place
  logic         was = 1'b0;
  logic         kept;
  logic [6:1]   valid;
  logic [3:0]   asked;
  logic [99:0]  infos;
  logic [4*R-1:0] read;
  logic [3:0]   needed_3;
  logic [11:0]  needed;
  logic [35:0]  address_3;
  logic [45:0]  rows_3;
  logic [25:0]  columns_3;
  logic [71:0]  rows_4;
  logic [33:0]  columns_4;
  logic [287:0] wanted;
  always @(posedge clk) begin
    was <= 1'b1;
    valid <= !rst_n ? 6'd0 : moves ? {\dut.valid [5:1], in_valid} : \dut.valid ;
    asked <= !rst_n || leaves ? 4'd0 : \dut.asked | (4'(asks) << bank);
    kept <= rst_n && !flush && !forget && (\dut.kept [any] || (asks && any == {bank, out_places[P*bank +: P]}));
    infos <= moves ? {\dut.infos [49:0], in_address[39:4], in_plane, in_section, in_strips_x} : \dut.infos ;
    read <= moves ? {\dut.blocks.any , places, \dut.read_3 , \dut.read_4 , \dut.read_5 } : {\dut.read_3 , \dut.read_4 , \dut.read_5 , \dut.read_6 };
    needed_3 <= moves ? {rows_needed, columns_needed} : {\dut.rows_needed_3 , \dut.columns_needed_3 };
    for (integer b = 0; b < 4; b = b + 1) begin
      needed[8+b] <= moves ? \dut.rows_needed_3 [b/2] && \dut.columns_needed_3 [b%2] : \dut.needed_4 [b];
      wanted[144+36*b +: 36] <= moves ? \dut.rows_4 [b/2*36 +: 36] + 36'(\dut.columns_4 [b%2*17 +: 17]) : \dut.wanted_5 [36*b +: 36];
    end
    needed[7:0] <= moves ? {\dut.needed_4 , \dut.needed_5 } : {\dut.needed_5 , \dut.needed_6 };
    wanted[143:0] <= moves ? \dut.wanted_5 : \dut.wanted ;
    {address_3, columns_3} <= moves ? {address, columns} : {\dut.address_3 , \dut.columns_3 };
    // In units of 16 bytes, of which a strip's place has 9.
    for (integer p = 0; p < 2; p = p + 1) begin
      rows_3[23*p +: 23] <= moves ? 23'(\dut.rows_2 [13*p +: 13]) * 23'(strips_x) : \dut.rows_3 [23*p +: 23];
      rows_4[36*p +: 36] <= moves ? \dut.address_3 + 36'(\dut.rows_3 [23*p +: 23]) * 36'd9 : \dut.rows_4 [36*p +: 36];
      columns_4[17*p +: 17] <= moves ? 17'(\dut.columns_3 [13*p +: 13]) * 17'd9 : \dut.columns_4 [17*p +: 17];
    end
  end
  always @* begin
    if (!was) begin
      assert (\dut.blocks.given == {moves, in_x, in_y, in_extra_x, in_extra_y, in_width, in_height});
      assert (in_ready == moves && ask == asks && out_valid == (\dut.valid [6] && missing == 0));
      if (ask) assert (ask_address == {\dut.wanted [36*bank +: 36], 4'd0} && ask_place == {bank, out_places[P*bank +: P]});
      assert ({out_block_x, out_block_y, out_two_x, out_two_y, out_select_x, out_select_y, out_places} == \dut.read_6 );
      assert (out_missed == 3'(\dut.asked [0]) + 3'(\dut.asked [1]) + 3'(\dut.asked [2]) + 3'(\dut.asked [3]));
      assert (\dut.rows_2 == rows);
      assert (writes == 4'(asks) << bank && reads == {4{moves}} && read_at == \dut.read_5 [4*P-1:0]);
      if (asks) assert (write_at[P*bank +: P] == out_places[P*bank +: P] && written[36*bank +: 36] == \dut.wanted [36*bank +: 36]);
    end else begin
      assert (\dut.valid == valid && \dut.asked == asked && \dut.kept [any] == kept && \dut.infos == infos);
      assert ({\dut.read_3 , \dut.read_4 , \dut.read_5 , \dut.read_6 } == read);
      assert ({\dut.rows_needed_3 , \dut.columns_needed_3 } == needed_3 && {\dut.needed_4 , \dut.needed_5 , \dut.needed_6 } == needed);
      assert ({\dut.address_3 , \dut.columns_3 } == {address_3, columns_3});
      assert (\dut.rows_3 == rows_3);
      assert (\dut.rows_4 == rows_4 && \dut.columns_4 == columns_4);
      assert ({\dut.wanted_5 , \dut.wanted } == wanted);
    end
  end
endmodule
