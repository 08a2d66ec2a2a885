// Of place 5 of any bank, with any order of windows, stalls of both sides and forgetting:
//   - a window leaves only when the strip that it needs there is the one asked for last there, by itself or since all
//     were forgotten;
//   - a strip is asked for only by a window that needs it, at its place, once, and not when it is kept;
//   - a window asks, leaves or both whenever the other side is ready; out_missed is the number that it asked for.
// Which strips a window needs, and their addresses and places: proof reference_lookup_step.
// BLOCK_LOG2 = 2, STRIPS = 64, SECTIONS = 1.
//
// Clauses: Prefetching (docs/pipeline.md)
// Engine: induction 1 3
// Cover: 12
// Complete: the place's content is bound to its tag, so the induction needs no reachability.
module prove_reference_lookup (
  input logic clk, input logic rst_n, input logic flush, input logic forget, input logic in_valid,
      input logic [39:0] in_address,
  input logic [1:0] in_plane, input logic [10:0] in_strips_x, input logic [14:0] in_width, input logic [14:0] in_height,
  input logic [16:0] in_x, input logic [16:0] in_y, input logic in_extra_x, input logic in_extra_y,
      input logic ask_ready,
  input logic out_ready
);
  logic        in_ready, ask, out_valid;
  logic [39:0] ask_address;
  logic [5:0]  ask_place;
  logic [2:0]  out_missed;
  logic [15:0] out_places;
  hmlfc_reference_lookup #(.BLOCK_LOG2(2), .STRIPS(64), .SECTIONS(1)) dut (
    .clk(clk), .rst_n(rst_n), .flush(flush), .forget(forget), .in_valid(in_valid), .in_ready(in_ready),
    .in_address(in_address), .in_plane(in_plane), .in_section(1'b0), .in_strips_x(in_strips_x), .in_width(in_width),
    .in_height(in_height), .in_x(in_x), .in_y(in_y), .in_extra_x(in_extra_x), .in_extra_y(in_extra_y), .ask(ask),
    .ask_ready(ask_ready), .ask_address(ask_address), .ask_place(ask_place), .out_valid(out_valid),
    .out_ready(out_ready), .out_places(out_places), .out_missed(out_missed));

  // The window at its lookup.
  (* hierconn *) wire [6:1] \dut.valid ;
  (* hierconn *) wire [3:0] \dut.needed_6 ;
  (* hierconn *) wire [131:0] \dut.wanted ;
  (* hierconn *) wire [3:0] \dut.asked ;
  (* hierconn *) wire [63:0] \dut.kept ;
  (* hierconn *) wire [32:0] \dut.g_tags[0].tag ;
  (* hierconn *) wire [32:0] \dut.g_tags[1].tag ;
  (* hierconn *) wire [32:0] \dut.g_tags[2].tag ;
  (* hierconn *) wire [32:0] \dut.g_tags[3].tag ;
  (* hierconn *) wire [32:0] \dut.g_tags[0].tags.words[5] ;
  (* hierconn *) wire [32:0] \dut.g_tags[1].tags.words[5] ;
  (* hierconn *) wire [32:0] \dut.g_tags[2].tags.words[5] ;
  (* hierconn *) wire [32:0] \dut.g_tags[3].tags.words[5] ;
  wire [131:0] read = {\dut.g_tags[3].tag , \dut.g_tags[2].tag , \dut.g_tags[1].tag , \dut.g_tags[0].tag };
  wire [131:0] tags = {\dut.g_tags[3].tags.words[5] , \dut.g_tags[2].tags.words[5] , \dut.g_tags[1].tags.words[5] ,
      \dut.g_tags[0].tags.words[5] };

  // What was asked for last at the place, and whether it is kept.
  (* anyconst *) logic [1:0] bank;
  localparam logic [3:0] PLACE = 4'd5;
  logic        started = 1'b0;
  logic        full;
  logic [32:0] content;
  logic [2:0]  missed;
  wire         here = \dut.valid [6] && \dut.needed_6 [bank] && out_places[4*bank +: 4] == PLACE;
  wire [32:0]  own = \dut.wanted [33*bank +: 33];
  wire         asked_here = ask && ask_place == {bank, PLACE};
  (* hierconn *) wire \dut.g_tags[0].late ;
  (* hierconn *) wire \dut.g_tags[1].late ;
  (* hierconn *) wire \dut.g_tags[2].late ;
  (* hierconn *) wire \dut.g_tags[3].late ;
  (* hierconn *) wire \dut.g_tags[0].same ;
  (* hierconn *) wire \dut.g_tags[1].same ;
  (* hierconn *) wire \dut.g_tags[2].same ;
  (* hierconn *) wire \dut.g_tags[3].same ;
  wire [3:0] late = {\dut.g_tags[3].late , \dut.g_tags[2].late , \dut.g_tags[1].late , \dut.g_tags[0].late };
  wire [3:0] same = {\dut.g_tags[3].same , \dut.g_tags[2].same , \dut.g_tags[1].same , \dut.g_tags[0].same };
  wire         leaves = out_valid && out_ready;
  always @(posedge clk) begin
    started <= 1'b1;
    if (!rst_n || flush || forget) full <= 1'b0;
    else if (asked_here) full <= 1'b1;
    if (asked_here) content <= ask_address[39:7];
    missed <= !rst_n || leaves ? 3'd0 : missed + {2'd0, ask};
  end

  always @* begin
    if (!started) assume (!rst_n);
    else begin
      assert (full == \dut.kept [16*bank+5]);
      if (full) assert (tags[33*bank +: 33] == content);
      if (\dut.valid [6] && out_places[4*bank +: 4] == PLACE && !\dut.asked [bank] && full)
        assert (late[bank] ? same[bank] == (content == own) : read[33*bank +: 33] == content);
      if (\dut.asked [bank]) assert (\dut.valid [6]);
      if (\dut.asked [bank] && here) assert (content == own);

      if (leaves && here) assert (asked_here || (content == own && (full || \dut.asked [bank])));
      if (ask && ask_place[5:4] == bank)
        assert (\dut.valid [6] && \dut.needed_6 [bank] && ask_place[3:0] == out_places[4*bank +: 4] &&
            ask_address == {own, 7'd0} &&
                !\dut.asked [bank]);
      if (asked_here) assert (!(full && content == own));
      if (\dut.valid [6]) assert (ask || out_valid || !ask_ready);
      assert (missed == {2'd0, \dut.asked [0]} + {2'd0, \dut.asked [1]} + {2'd0, \dut.asked [2]} +
          {2'd0, \dut.asked [3]});
      if (leaves) assert (out_missed == missed + {2'd0, ask});
    end
  end
  // A window that needs two strips leaves with both kept, after one that asked for four.
  logic four = 1'b0;
  always @(posedge clk) begin
    if (leaves && missed == 4) four <= 1'b1;
    cover (four && leaves && missed == 0 && here && full && (\dut.needed_6 == 4'b1100 || \dut.needed_6 == 4'b0011));
  end
endmodule
