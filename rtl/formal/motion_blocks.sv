// A block enters when its tile is loaded or it needs none, and moves on by a stage in each clock in which the last is empty or leaves; all others change
// nothing. In stage 1 the reader is asked for the index of its motion block in the tile, by what the head of the tile's context said; in stage 5 the
// palette of the context gives the motion. An error stays, else the first of head, index and entry is set (MOT-10). BLOCK_LOG2 = 2, 4 contexts.
//
// Clauses: MOT-3, MOT-4, MOT-10
// Engine: bmc 3
// Cut: element_reader
// Complete: one step of six stages with anything in them, after a head or an entry was written.
// Fault: hmlfc_motion_blocks.sv / index_5 > 4'(palette_sizes[12+:3]) / index_5 > 4'(palette_sizes[9+:3])
// Fault: hmlfc_motion_blocks.sv / 10'(row_0) * 10'(columns_0) + 10'(column_0) / 10'(column_0) * 10'(columns_0) + 10'(row_0)
// Fault: hmlfc_motion_blocks.sv / .advance, / .advance(1'b1),
// Fault: hmlfc_motion_blocks.sv / valid[5] && flow_5.motion_asked / flow_5.motion_asked
`include "hmlfc_tables.svh"
module prove_motion_blocks (
  input logic clk, input logic [3:0] ready, input logic head_write, input logic [1:0] parsed_context, input logic [55:0] head, input logic palette_write,
  input logic [2:0] palette_number, input logic [32:0] palette_entry, input logic [127:0] window, input logic in_valid,
  input logic [hmlfc_pkg::FLOW_BITS-1:0] in_flow, input logic out_ready
);
  localparam integer F = hmlfc_pkg::FLOW_BITS;
  (* anyconst *) logic [750:0] stream_bits;
  hmlfc_pkg::config_t stream;
  assign stream = stream_bits;
  logic         release_valid, read_enable, in_ready, out_valid;
  logic [1:0]   release_context;
  logic [7:0]   read_word;
  logic [F-1:0] out_flow;
  hmlfc_motion_blocks #(.BLOCK_LOG2(2), .CONTEXTS(4), .CONTEXT_WORDS(64), .WINDOW_BITS(128)) dut (
    .clk(clk), .rst_n(1'b1), .stream(stream_bits), .ready(ready), .release_valid(release_valid), .release_context(release_context),
    .head_write(head_write), .parsed_context(parsed_context), .head_error(head[55:50]), .head_block_log2(head[49:47]), .head_columns(head[46:41]),
    .head_palette_size(head[40:38]), .head_level_code(head[37:32]), .head_total(head[31:18]), .head_position(head[17:0]),
    .palette_write(palette_write), .palette_number(palette_number), .palette_entry(palette_entry), .read_enable(read_enable),
    .read_word(read_word), .window(window), .in_valid(in_valid), .in_ready(in_ready), .in_flow(in_flow), .out_valid(out_valid),
    .out_ready(out_ready), .out_flow(out_flow));

  (* hierconn *) wire [6:1] \dut.valid ;
  (* hierconn *) wire [6*F-1:0] \dut.flows ;
  (* hierconn *) wire [14:0] \dut.palette_sizes ;
  (* hierconn *) wire [5:0] \dut.error_1 ;
  (* hierconn *) wire \dut.reader.advance ;
  (* hierconn *) wire [13:0] \dut.reader.position ;
  (* hierconn *) wire [13:0] \dut.reader.total ;
  (* hierconn *) wire [5:0] \dut.reader.level_code ;
  (* hierconn *) wire [9:0] \dut.reader.index ;
  (* hierconn *) wire [3:0] \dut.reader.value ;
  (* hierconn *) wire \dut.reader.read_enable ;
  (* hierconn *) wire [7:0] \dut.reader.read_word ;
  (* hierconn *) wire [127:0] \dut.reader.window ;

  // Any context and entry: what was written last, and then a block that needs it.
  (* anyconst *) logic [1:0] one;
  (* anyconst *) logic [2:0] number;
  logic         head_known = 1'b0, entry_known = 1'b0;
  logic [55:0]  head_of_one;
  logic [32:0]  entry_of_one;
  always @(posedge clk) begin
    if (head_write && parsed_context == one) {head_known, head_of_one} <= {1'b1, head};
    if (palette_write && parsed_context == one && palette_number == number) {entry_known, entry_of_one} <= {1'b1, palette_entry};
  end

  hmlfc_pkg::flow_t enters, leaves_1, at_5, leaves_5;
  hmlfc_pkg::motion_t entry;
  assign enters = in_flow;
  assign at_5 = \dut.flows [4*F +: F];
  assign entry = entry_of_one;
  wire        advance = !\dut.valid [6] || out_ready;
  wire        chroma_in_luma = enters.job.plane != 0 && !stream.chroma_444 && !stream.features.chroma_motion;
  wire [14:0] x = 15'(enters.job.bx) * (chroma_in_luma ? 15'd8 : 15'd4);
  wire [14:0] y = 15'(enters.job.by) * (chroma_in_luma ? 15'd8 : 15'd4);
  wire [6:0]  inside_x = x & ((15'd1 << stream.motion_tile_log2) - 15'd1);
  wire [6:0]  inside_y = y & ((15'd1 << stream.motion_tile_log2) - 15'd1);
  wire [4:0]  column = inside_x >> head_of_one[49:47];
  wire [4:0]  row = inside_y >> head_of_one[49:47];
  wire        moves = at_5.motion_asked && at_5.job.error == 0;
  wire        sees_head = head_known && enters.motion_context == one;
  wire        sees_entry = entry_known && at_5.motion_context == one && \dut.reader.value [2:0] == number;
  always @* begin
    leaves_1 = \dut.flows [0 +: F];
    if (leaves_1.job.error == 0 && leaves_1.motion_asked) leaves_1.job.error = \dut.error_1 ;
    leaves_5 = \dut.flows [4*F +: F];
    if (moves) begin
      leaves_5.motion = entry;
      leaves_5.motion.used = entry.choice != 0;
      if (!entry.used || \dut.reader.value > {1'b0, \dut.palette_sizes [14:12]}) leaves_5.job.error = HMLFC_ERROR_BAD_MODE;
    end
  end

  // What each stage holds after this clock.
  localparam integer ASKED = 6 + 14 + 14 + 6 + 10 + 3;
  logic           stepped = 1'b0, head_used, sixth_known;
  logic [6:1]     valid;
  logic [6*F-1:0] flows;
  logic [11:0]    sizes;
  logic [ASKED-1:0] asked;
  wire [ASKED-1:0] asks = {\dut.error_1 , \dut.reader.position , \dut.reader.total , \dut.reader.level_code , \dut.reader.index , \dut.palette_sizes [2:0]};
  always @(posedge clk) begin
    stepped <= 1'b1;
    valid <= advance ? {\dut.valid [5:1], in_valid && in_ready} : \dut.valid ;
    flows <= advance ? {leaves_5, \dut.flows [F +: 3*F], leaves_1, in_flow} : \dut.flows ;
    sizes <= advance ? \dut.palette_sizes [11:0] : \dut.palette_sizes [14:3];
    head_used <= !advance || sees_head;
    sixth_known <= !advance || !moves || sees_entry;
    asked <= advance ? {head_of_one[55:50], one, head_of_one[11:0], head_of_one[31:18], head_of_one[37:32],
                        10'(row) * 10'(head_of_one[46:41]) + 10'(column), head_of_one[40:38]} : asks;
  end
  always @* begin
    assert (\dut.reader.advance == advance && read_enable == \dut.reader.read_enable && read_word == \dut.reader.read_word );
    assert (\dut.reader.window [126:0] == window[126:0]);
    assert (in_ready == (advance && (!enters.motion_asked || ready[enters.motion_context])));
    assert (release_valid == (advance && \dut.valid [5] && at_5.motion_asked) && release_context == at_5.motion_context);
    assert (out_valid == \dut.valid [6] && out_flow == \dut.flows [5*F +: F]);
    if (stepped) begin
      assert (\dut.valid == valid && \dut.flows [0 +: 5*F] == flows[0 +: 5*F] && \dut.palette_sizes [14:3] == sizes);
      if (head_used) assert (asks == asked);
      if (sixth_known) assert (\dut.flows [5*F +: F] == flows[5*F +: F]);
    end
  end
endmodule
