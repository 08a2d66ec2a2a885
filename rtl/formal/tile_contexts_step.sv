// A step from any state in which no two kept tiles are the same: which context a block gets, the first free one from the oldest on where none has
// its tile; what is put on the list of loads, and comes from it; what each context keeps, and how many blocks need it, a clock later; flush, reset.
// 4 contexts; the refuted mutants are of 2, too.
//
// Clauses: Prefetching (docs/pipeline.md)
// Engine: bmc 2
// Cut: fifo
// Complete: any step; a load that ends is of a context in use (proof tile_contexts).
// Fault: hmlfc_tile_contexts.sv / oldest <= free_context + 1'b1 / oldest <= free_context
// Fault: hmlfc_tile_contexts.sv / for (int i = CONTEXTS - 1; i >= 0; i--) / for (int i = 0; i < CONTEXTS; i++)
// Fault: hmlfc_tile_contexts.sv / hit ? !crowded : / hit ? 1'b1 :
// Fault: hmlfc_tile_contexts.sv / counted <= context_number / counted <= free_context
module prove_tile_contexts_step #(
  parameter integer CONTEXTS = 4,
  parameter integer INFO_BITS = 17
) (
  input logic clk, input logic rst_n, input logic flush, input logic ask, input logic [hmlfc_pkg::TILE_BITS-1:0] tile,
  input logic [INFO_BITS-1:0] info, input logic load_ready, input logic loaded_valid, input logic [$clog2(CONTEXTS)-1:0] loaded_context,
  input logic loaded_keep, input logic release_valid, input logic [$clog2(CONTEXTS)-1:0] release_context
);
  localparam integer C = $clog2(CONTEXTS);
  localparam integer T = hmlfc_pkg::TILE_BITS;
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
  (* hierconn *) wire [10*CONTEXTS-1:0] \dut.users ;
  (* hierconn *) wire [C-1:0] \dut.oldest ;
  (* hierconn *) wire \dut.counts ;
  (* hierconn *) wire [C-1:0] \dut.counted ;
  // The list.
  (* hierconn *) wire \dut.loads.rst_n ;
  (* hierconn *) wire \dut.loads.in_valid ;
  (* hierconn *) wire \dut.loads.in_ready ;
  (* hierconn *) wire [C+T+INFO_BITS-1:0] \dut.loads.in_data ;
  (* hierconn *) wire \dut.loads.out_valid ;
  (* hierconn *) wire \dut.loads.out_ready ;
  (* hierconn *) wire [C+T+INFO_BITS-1:0] \dut.loads.out_data ;

  // Context by context: it has the tile, it is free, it is counted now.
  logic [CONTEXTS-1:0] holds, free, is_counted;
  always @* for (integer i = 0; i < CONTEXTS; i = i + 1) begin
    holds[i] = \dut.kept [i] && \dut.tiles [T*i +: T] == tile;
    is_counted[i] = \dut.counts && \dut.counted == i;
    free[i] = \dut.users [10*i +: 10] == 0 && !is_counted[i];
  end
  wire hit = holds != 0;
  wire load = ask && !hit && free != 0 && \dut.loads.in_ready ;
  wire [9:0] blocks = \dut.users [10*number +: 10];
  wire [C-1:0] passed = number - \dut.oldest ;  // contexts that are not free, from the oldest on

  logic                  was = 1'b0;
  logic [CONTEXTS-1:0]   next_kept, next_ready;
  logic [CONTEXTS*T-1:0] next_tiles;
  logic [10*CONTEXTS-1:0] next_users;
  logic [C-1:0]          next_oldest, next_counted;
  logic                  next_counts;
  wire forgets = !rst_n || flush;
  always @(posedge clk) begin
    was <= 1'b1;
    for (integer i = 0; i < CONTEXTS; i = i + 1) begin
      next_kept[i] <= !forgets && ((load && number == i) || (\dut.kept [i] && !(loaded_valid && loaded_context == i && !loaded_keep)));
      next_ready[i] <= !forgets && !(load && number == i) && (ready[i] || (loaded_valid && loaded_context == i));
      next_tiles[T*i +: T] <= load && number == i ? tile : \dut.tiles [T*i +: T];
      next_users[10*i +: 10] <= rst_n ? \dut.users [10*i +: 10] + 10'(is_counted[i]) - 10'(release_valid && release_context == i) : 10'd0;
    end
    next_oldest <= forgets ? {C{1'b0}} : load ? C'(number + 1) : \dut.oldest ;
    next_counts <= rst_n && ask && granted;
    next_counted <= number;
  end
  always @* begin
    // Proved of all runs by tile_contexts.
    assume ((holds & (holds - 1'b1)) == 0);
    if (loaded_valid) assume (!free[loaded_context]);

    assert (granted == (hit ? blocks < 1022 : free != 0 && \dut.loads.in_ready ));
    if (hit) assert (holds[number]);
    else if (free != 0) begin
      assert (free[number]);
      for (integer i = 0; i < CONTEXTS; i = i + 1) if (C'(i - \dut.oldest ) < passed) assert (!free[i]);
    end
    assert (\dut.loads.in_valid == load && \dut.loads.rst_n == rst_n && \dut.loads.out_ready == load_ready && load_valid == \dut.loads.out_valid );
    if (load) assert (\dut.loads.in_data == {number, tile, info});
    assert ({load_context, load_tile, load_info} == \dut.loads.out_data );
    if (was) begin
      assert (\dut.kept == next_kept && ready == next_ready && \dut.tiles == next_tiles && \dut.users == next_users);
      assert (\dut.oldest == next_oldest && \dut.counts == next_counts);
      if (next_counts) assert (\dut.counted == next_counted);
    end
  end
endmodule
