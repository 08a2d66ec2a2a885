// Of each context, from any legal state, one step: a block gets the context that has its tile, while fewer than 1022 blocks need it; else the first from
// the oldest on that nobody needs, whose load is put on the list at once; else nothing. Each context keeps its tile, whether it is ready, and the count
// of its blocks, until its own turn.
//
// Clauses: Prefetching (docs/pipeline.md)
// Engine: bmc 2
// Complete: any state in which no tile is kept twice, and one step from it; the list of loads may do anything (proof fifo).
// Fault: hmlfc_tile_contexts.sv / crowded = &users[hit_context*USER_BITS+1+:USER_BITS-1] / crowded = &users[hit_context*USER_BITS+:USER_BITS]
// Fault: hmlfc_tile_contexts.sv / users[i*USER_BITS+:USER_BITS] - 1'b1 / users[i*USER_BITS+:USER_BITS] - 2'd2
// Fault: hmlfc_tile_contexts.sv / tiles[free_context*TILE_BITS+:TILE_BITS] <= tile / tiles[free_context*TILE_BITS+:TILE_BITS-1] <= tile
// Fault: hmlfc_tile_contexts.sv / oldest <= free_context + 1'b1 / oldest <= free_context

// In the place of the list of loads.
module hmlfc_fifo #(parameter integer WIDTH = 8, parameter integer DEPTH = 4) (
  input logic clk, input logic rst_n, input logic in_valid, output logic in_ready, input logic [WIDTH-1:0] in_data, output logic out_valid,
  input logic out_ready, output logic [WIDTH-1:0] out_data, output logic [$clog2(DEPTH):0] count
);
  (* anyseq *) logic [WIDTH+1:0] any;
  wire [WIDTH+2:0] given = {rst_n, in_valid, out_ready, in_data};
  assign {in_ready, out_valid, out_data} = any;
endmodule

module prove_tile_contexts_step #(
  parameter integer CONTEXTS = 4,
  parameter integer INFO_BITS = 17,
  localparam integer C = $clog2(CONTEXTS)
) (
  input logic clk, input logic rst_n, input logic flush, input logic ask, input logic [hmlfc_pkg::TILE_BITS-1:0] tile,
  input logic [INFO_BITS-1:0] info, input logic load_ready, input logic loaded_valid, input logic [C-1:0] loaded_context, input logic loaded_keep,
  input logic release_valid, input logic [C-1:0] release_context
);
  localparam integer T = hmlfc_pkg::TILE_BITS;
  localparam integer U = 10;
  localparam integer L = C + T + INFO_BITS;
  logic         granted, load_valid;
  logic [C-1:0] number, load_context;
  logic [INFO_BITS-1:0] load_info;
  logic [T-1:0] load_tile;
  logic [CONTEXTS-1:0] ready;
  hmlfc_tile_contexts #(.CONTEXTS(CONTEXTS), .INFO_BITS(INFO_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .flush(flush), .ask(ask), .tile(tile), .info(info), .granted(granted), .context_number(number),
    .load_valid(load_valid), .load_ready(load_ready), .load_context(load_context), .load_tile(load_tile), .load_info(load_info),
    .loaded_valid(loaded_valid), .loaded_context(loaded_context), .loaded_keep(loaded_keep), .ready(ready),
    .release_valid(release_valid), .release_context(release_context));
  (* hierconn *) wire [CONTEXTS-1:0] \dut.kept ;
  (* hierconn *) wire [CONTEXTS*T-1:0] \dut.tiles ;
  (* hierconn *) wire [CONTEXTS*U-1:0] \dut.users ;
  (* hierconn *) wire [C-1:0] \dut.oldest ;
  (* hierconn *) wire \dut.counts ;
  (* hierconn *) wire [C-1:0] \dut.counted ;
  (* hierconn *) wire [L+1:0] \dut.loads.any ;
  (* hierconn *) wire [L+2:0] \dut.loads.given ;

  logic [CONTEXTS-1:0] has, needed, crowded, first;  // of each context
  logic                twice;
  integer              i, k;
  always @* begin
    twice = 1'b0;
    for (i = 0; i < CONTEXTS; i = i + 1) begin
      has[i] = \dut.kept [i] && \dut.tiles [T*i +: T] == tile;
      needed[i] = \dut.users [U*i +: U] != 0 || (\dut.counts && \dut.counted == i);
      crowded[i] = \dut.users [U*i +: U] >= 1022;
      for (k = 0; k < i; k = k + 1) if (\dut.kept [i] && \dut.kept [k] && \dut.tiles [T*i +: T] == \dut.tiles [T*k +: T]) twice = 1'b1;
    end
    // The first from the oldest on: none that nobody needs is nearer to it.
    for (i = 0; i < CONTEXTS; i = i + 1) begin
      first[i] = !needed[i];
      for (k = 0; k < CONTEXTS; k = k + 1) if (!needed[k] && C'(k - \dut.oldest ) < C'(i - \dut.oldest )) first[i] = 1'b0;
    end
  end
  wire list_ready = \dut.loads.any [L+1];
  wire hit = has != 0;
  wire may = hit ? (has & crowded) == 0 : first != 0 && list_ready;
  wire loads = ask && !hit && may;
  wire [CONTEXTS-1:0] gets = hit ? has : first;

  logic                was = 1'b0, was_reset = 1'b0, was_any_reset = 1'b0, next_counts;
  logic [C-1:0]        next_counted, next_oldest;
  logic [CONTEXTS-1:0] next_kept, next_ready;
  logic [CONTEXTS*T-1:0] next_tiles;
  logic [CONTEXTS*U-1:0] next_users;
  always @(posedge clk) begin
    was <= rst_n;
    was_reset <= !rst_n;
    was_any_reset <= !rst_n || flush;
    {next_kept, next_ready, next_tiles, next_users, next_oldest} <= {\dut.kept , ready, \dut.tiles , \dut.users , \dut.oldest };
    next_counts <= ask && may;
    next_counted <= number;
    if (loads) next_oldest <= number + 1'b1;
    for (i = 0; i < CONTEXTS; i = i + 1) begin
      next_users[U*i +: U] <= \dut.users [U*i +: U] + U'(\dut.counts && \dut.counted == i) - U'(release_valid && release_context == i);
      if (loaded_valid && loaded_context == i) begin
        next_ready[i] <= 1'b1;
        if (!loaded_keep) next_kept[i] <= 1'b0;
      end
      if (loads && first[i]) begin
        {next_kept[i], next_ready[i]} <= 2'b10;
        next_tiles[T*i +: T] <= tile;
      end
    end
  end
  always @* begin
    assume (!twice && (!loaded_valid || needed[loaded_context]));
    assert (granted == may && \dut.loads.given [L+2 -: 3] == {rst_n, loads, load_ready});
    if (granted) assert (gets == 1 << number);
    if (loads) assert (\dut.loads.given [L-1:0] == {number, tile, info});
    assert ({load_valid, load_context, load_tile, load_info} == \dut.loads.any [L:0]);
    if (was_any_reset) assert (\dut.kept == 0 && ready == 0 && \dut.oldest == 0);
    if (was_reset) assert (\dut.users == 0 && !\dut.counts );
    if (was && !was_any_reset) assert ({\dut.kept , ready, \dut.oldest } == {next_kept, next_ready, next_oldest});
    if (was) begin
      assert (\dut.users == next_users && \dut.counts == next_counts && (!next_counts || \dut.counted == next_counted));
      assert (\dut.tiles == next_tiles);
    end
  end
endmodule
