// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Which tiles are kept, and how many blocks still need each.
//
// A block that needs a tile asks for it in order (`ask`, `tile`, `info`) and gets the number of the
// context that holds it, or that it is being loaded into (`granted` with `context`, in the same clock).
// A tile that no context holds is put on the list of loads. `ready` has a bit for each context that
// is loaded. `release_valid`: one block that asked is done with its context; a context is
// taken for another tile when all of them are.
//
// A context loaded without `loaded_keep` serves those that asked already, and is loaded anew for the
// next: so a bus error hits only the blocks that met it. `flush`, given while none is in use, forgets all.
module hmlfc_tile_contexts #(
    parameter int CONTEXTS = 4,  // a power of two
    parameter int INFO_BITS = 8,  // what the loader needs to know besides the tile's number
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS,
    localparam int CONTEXT_BITS = $clog2(CONTEXTS)
) (
    input logic clk,
    input logic rst_n,
    input logic flush,

    input logic ask,
    input logic [TILE_BITS-1:0] tile,
    input logic [INFO_BITS-1:0] info,
    output logic granted,
    output logic [CONTEXT_BITS-1:0] context_number,

    output logic load_valid,
    input logic load_ready,
    output logic [CONTEXT_BITS-1:0] load_context,
    output logic [TILE_BITS-1:0] load_tile,
    output logic [INFO_BITS-1:0] load_info,

    input logic loaded_valid,
    input logic [CONTEXT_BITS-1:0] loaded_context,
    input logic loaded_keep,
    output logic [CONTEXTS-1:0] ready,

    input logic release_valid,
    input logic [CONTEXT_BITS-1:0] release_context
);

  localparam int USER_BITS = 10;

  logic [CONTEXTS-1:0] kept, free;
  logic [CONTEXTS*TILE_BITS-1:0] tiles;
  logic [CONTEXTS*USER_BITS-1:0] users;
  logic [CONTEXT_BITS-1:0] oldest;

  // A block that got its context is counted a clock later.
  logic counts;
  logic [CONTEXT_BITS-1:0] counted;

  logic [CONTEXTS-1:0] taken, released;  // a block gets its context, or gives it back
  assign taken = CONTEXTS'(counts) << counted;
  assign released = CONTEXTS'(release_valid) << release_context;
  logic hit, found, crowded;
  logic [CONTEXT_BITS-1:0] hit_context, free_context;
  always_comb begin
    hit = 1'b0;
    hit_context = '0;
    crowded = 1'b0;
    found = 1'b0;
    free_context = '0;
    for (int i = 0; i < CONTEXTS; i++) begin
      free[i] = users[i*USER_BITS+:USER_BITS] == 0 && !taken[i];
      if (kept[i] && tiles[i*TILE_BITS+:TILE_BITS] == tile) begin
        hit = 1'b1;
        hit_context = CONTEXT_BITS'(i);
        crowded = &users[i*USER_BITS+1+:USER_BITS-1];
      end
    end
    for (int i = CONTEXTS - 1; i >= 0; i--) begin
      if (free[CONTEXT_BITS'(oldest+CONTEXT_BITS'(i))]) begin
        found = 1'b1;
        free_context = CONTEXT_BITS'(oldest + CONTEXT_BITS'(i));
      end
    end
  end

  logic list_ready;
  wire load = ask && !hit && found && list_ready;
  assign granted = hit ? !crowded : found && list_ready;
  assign context_number = hit ? hit_context : free_context;

  hmlfc_fifo #(.WIDTH(CONTEXT_BITS + TILE_BITS + INFO_BITS), .DEPTH(CONTEXTS)) loads (
      .clk, .rst_n, .in_valid(load), .in_ready(list_ready), .in_data({free_context, tile, info}),
      .out_valid(load_valid), .out_ready(load_ready), .out_data({load_context, load_tile, load_info}), .count()
  );

  always_ff @(posedge clk) begin
    counts <= ask && granted;
    counted <= context_number;
    for (int i = 0; i < CONTEXTS; i++) begin
      if (taken[i] != released[i]) begin
        users[i*USER_BITS+:USER_BITS] <= users[i*USER_BITS+:USER_BITS] + (released[i] ? {USER_BITS{1'b1}} : USER_BITS'(1));
      end
      if (load && free_context == CONTEXT_BITS'(i)) tiles[i*TILE_BITS+:TILE_BITS] <= tile;
    end
    if (loaded_valid) begin
      ready[loaded_context] <= 1'b1;
      if (!loaded_keep) kept[loaded_context] <= 1'b0;
    end
    if (load) begin
      kept[free_context] <= 1'b1;
      ready[free_context] <= 1'b0;
      oldest <= free_context + 1'b1;
    end
    if (!rst_n || flush) begin
      kept <= '0;
      ready <= '0;
      oldest <= '0;
    end
    if (!rst_n) begin
      users <= '0;
      counts <= 1'b0;
    end
  end

endmodule

`default_nettype wire
