// Of any context, with any order of requests, loads and releases:
//   - it is taken for another tile only when all blocks that got it are done with it; the count of these never
//   overflows;
//   - a block gets it only for its own tile; a tile is never kept in two contexts;
//   - each taking puts it once on the list of loads, with its tile and information; it is ready just when that load has
//   ended;
//   - after a load without loaded_keep no block gets it for that tile before it is loaded anew.
// CONTEXTS = 4.
//
// Clauses: Prefetching (docs/pipeline.md)
// Engine: induction 2 5
// Cover: 11
// Complete: the context's state and its entry on the list are bound to the module's registers, so the induction needs
// no reachability.
module prove_tile_contexts #(
  parameter integer CONTEXTS = 4,
  parameter integer INFO_BITS = 2,
  localparam integer C = $clog2(CONTEXTS)
) (
  input logic clk, input logic rst_n, input logic flush, input logic ask, input logic [hmlfc_pkg::TILE_BITS-1:0] tile,
  input logic [INFO_BITS-1:0] info, input logic load_ready, input logic loaded_valid,
      input logic [C-1:0] loaded_context, input logic loaded_keep,
  input logic release_valid, input logic [C-1:0] release_context
);
  localparam integer T = hmlfc_pkg::TILE_BITS;
  logic         granted, load_valid;
  logic [C-1:0] number, load_context;
  logic [INFO_BITS-1:0] load_info;
  logic [T-1:0] load_tile;
  logic [CONTEXTS-1:0] ready;
  hmlfc_tile_contexts #(.CONTEXTS(CONTEXTS), .INFO_BITS(INFO_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .flush(flush), .ask(ask), .tile(tile), .info(info), .granted(granted),
    .context_number(number), .load_valid(load_valid), .load_ready(load_ready), .load_context(load_context),
    .load_tile(load_tile), .load_info(load_info), .loaded_valid(loaded_valid), .loaded_context(loaded_context),
    .loaded_keep(loaded_keep), .ready(ready), .release_valid(release_valid), .release_context(release_context));

  (* hierconn *) wire \dut.hit ;
  (* hierconn *) wire [CONTEXTS-1:0] \dut.kept ;
  (* hierconn *) wire [CONTEXTS*T-1:0] \dut.tiles ;
  (* hierconn *) wire [10*CONTEXTS-1:0] \dut.users ;
  (* hierconn *) wire \dut.counts ;
  (* hierconn *) wire [C-1:0] \dut.counted ;

  // The context that is watched, and another.
  (* anyconst *) logic [C-1:0] c;
  (* anyconst *) logic [C-1:0] other;

  // What it is for, and since when.
  localparam logic [1:0] IDLE = 2'd0, LISTED = 2'd1, LOADING = 2'd2;
  logic         started = 1'b0;
  logic [1:0]   state;
  logic [10:0]  inside;  // blocks that got it and are not done
  logic         spoiled, used_before;
  logic [T-1:0] own;
  logic [INFO_BITS-1:0] own_info;
  wire          gets = ask && granted && number == c;
  wire          taken = gets && !\dut.hit ;
  wire          handed_out = load_valid && load_ready && load_context == c;
  wire          loaded = loaded_valid && loaded_context == c;
  wire          done = release_valid && release_context == c;
  always @(posedge clk) begin
    started <= 1'b1;
    if (!rst_n) begin
      inside <= 11'd0;
      state <= IDLE;
      used_before <= 1'b0;
    end else begin
      inside <= inside + {10'd0, gets} - {10'd0, done};
      if (handed_out) state <= LOADING;
      if (loaded) state <= IDLE;
      if (taken) state <= LISTED;
      if (taken) used_before <= 1'b1;
    end
    if (loaded) spoiled <= !loaded_keep;
    if (taken) begin
      spoiled <= 1'b0;
      {own, own_info} <= {tile, info};
    end
  end

  // The list of loads, the oldest low, of four contexts.
  localparam integer L = C + T + INFO_BITS;
  (* hierconn *) wire [L-1:0] \dut.loads.storage.words[0] ;
  (* hierconn *) wire [L-1:0] \dut.loads.storage.words[1] ;
  (* hierconn *) wire [L-1:0] \dut.loads.storage.words[2] ;
  (* hierconn *) wire [L-1:0] \dut.loads.storage.words[3] ;
  (* hierconn *) wire [2:0] \dut.loads.taken ;
  (* hierconn *) wire [2:0] \dut.loads.written ;
  wire [4*L-1:0] storage = {\dut.loads.storage.words[3] , \dut.loads.storage.words[2] , \dut.loads.storage.words[1] ,
      \dut.loads.storage.words[0] };
  wire [4*L-1:0] turned = {storage, storage} >> (L * \dut.loads.taken [1:0]);
  wire [2:0]     count = \dut.loads.written - \dut.loads.taken ;
  logic [3:0]    is_own;
  always @* for (integer k = 0; k < 4; k = k + 1) is_own[k] = k < count && turned[L*k+T+INFO_BITS +: 2] == c;
  always @* if (started) begin
    assert (count <= 4 && is_own == (is_own & -is_own) && (is_own != 0) == (state == LISTED));
    for (integer k = 0; k < 4; k = k + 1) if (is_own[k]) assert (turned[L*k +: T+INFO_BITS] == {own, own_info});
  end

  always @* begin
    if (!started) assume (!rst_n);
    // The contract of the blocks, the loader and control.
    if (done) assume (inside != 0 && ready[c]);
    if (loaded) assume (state == LOADING);
    if (flush) assume (inside == 0 && !ask);

    if (started) begin
      assert (inside <= 1023 && inside == {1'b0, \dut.users [10*c +: 10]} + {10'd0, \dut.counts && \dut.counted == c});
      assert (ready[c] || inside == 0 || state != IDLE);
      if (state != IDLE) assert (\dut.kept [c] && !ready[c] && inside != 0);
      if (inside != 0 || \dut.kept [c]) assert (\dut.tiles [T*c +: T] == own);
      if (\dut.kept [c] && state == IDLE) assert (ready[c] && !spoiled);
      if (c != other && \dut.kept [c] && \dut.kept [other]) assert (\dut.tiles [T*c +: T] != \dut.tiles [T*other +: T]);

      if (taken) assert (inside == 0 && state == IDLE);
      if (gets && !taken) assert (tile == own && !(spoiled && state == IDLE));
      if (handed_out) assert (state == LISTED && load_tile == own && load_info == own_info);
    end
  end
  // It is loaded for a second tile after a block was done with the first.
  always @(posedge clk) cover (started && loaded && used_before && loaded_keep && reused);
  logic reused = 1'b0;
  always @(posedge clk) if (rst_n && taken && used_before && tile != own) reused <= 1'b1;
endmodule
