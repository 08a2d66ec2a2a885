// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Turns requests into blocks of levels: one job for each plane and each level from where DEC-1 begins down to the stop
// level.
//
// Requests wait until a stream is loaded. One whose view, level, plane or block is not there, or that meets a failed
// LOAD, becomes one job that carries the error. Views are worked out when they are not held: the table keeps VIEWS of
// them, half as many where the tree has more than four levels, and the oldest of which no block is in flight makes
// room. For RGB the chroma blocks are omitted where the previous request for RGB decoded them, but not where
// they met a bus error. A request for residuals is one job, of its stop level. Up to two requests wait; the first of
// them is checked and looked up, and its view worked out, while jobs of the one before leave.
module hmlfc_requests #(
    parameter int VIEWS = hmlfc_pkg::VIEWS,  // at most hmlfc_pkg::VIEWS
    localparam int VIEW_BITS = $clog2(VIEWS)
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic enable,  // a LOAD has ended
    input logic [5:0] load_error,
    input logic flush,  // a LOAD begins, while no job is in flight

    input logic s_valid,
    output logic s_ready,
    input logic [63:0] s_data,
    input logic s_last,

    output logic view_start,
    output logic [9:0] view_row,
    output logic [9:0] view_col,
    output logic [VIEW_BITS-1:0] view_slot,
    input logic view_done,
    input logic [hmlfc_pkg::LEVELS-1:0] view_keys,

    output logic job_valid,
    input logic job_ready,
    output hmlfc_pkg::job_t job,

    input logic chroma_spoiled,  // chroma that was decoded for RGB met a bus error
    input logic finished_valid,  // a job has left the unit
    input logic [VIEW_BITS-1:0] finished_slot
);

  localparam int LEVELS = hmlfc_pkg::LEVELS;

  // The next request: checked, and its view looked up, or worked out. It passes when its view is held and the jobs of
  // the previous one are done.
  logic next_valid, next_last, next_ready, waiting_ready;
  logic [63:0] next;
  hmlfc_fifo #(.WIDTH(65), .DEPTH(2)) waiting (
      .clk, .rst_n, .in_valid(s_valid && enable), .in_ready(waiting_ready), .in_data({s_last, s_data}),
      .out_valid(next_valid), .out_ready(next_ready), .out_data({next_last, next}), .count()
  );
  assign s_ready = enable && waiting_ready;
  wire [11:0] row = next[11:0];
  wire [11:0] col = next[23:12];
  wire [14:0] bx = next[38:24];
  wire [14:0] by = next[53:39];
  wire [1:0] plane = next[55:54];
  wire [3:0] stop = next[59:56];
  wire residuals = next[60];

  wire of_chroma = plane == 2'd1 || plane == 2'd2;
  wire in_luma = bx < 15'(stream.luma.blocks_x) && by < 15'(stream.luma.blocks_y);
  wire in_chroma = bx < 15'(stream.chroma.blocks_x) && by < 15'(stream.chroma.blocks_y);
  wire there = row < 12'(stream.rows) && col < 12'(stream.cols) && (of_chroma ? in_chroma : in_luma) &&
      stop <= 4'(stream.tree_height) && next[63:61] == 0 && !(residuals && plane == 2'd3);

  // Views that are held.
  logic [VIEWS-1:0] held;
  logic [VIEW_BITS-1:0] slot;  // of the latest
  wire [VIEW_BITS-1:0] following = slot + 1'b1;
  wire [VIEW_BITS-1:0] candidate = {following[VIEW_BITS-1] && stream.tree_height < 3'd4, following[VIEW_BITS-2:0]};
  logic [VIEWS*10-1:0] held_rows, held_cols;
  logic [VIEWS*LEVELS-1:0] held_keys;
  logic [VIEWS*10-1:0] users;
  logic any_hit;
  logic [VIEWS-1:0] used;  // by blocks in flight
  logic [VIEW_BITS-1:0] next_slot;
  logic [LEVELS-1:0] next_keys;
  always_comb begin
    any_hit = 1'b0;
    next_slot = '0;
    next_keys = '0;
    for (int i = 0; i < VIEWS; i++) begin
      used[i] = users[i*10+:10] != 0;
      if (held[i] && held_rows[i*10+:10] == row[9:0] && held_cols[i*10+:10] == col[9:0]) begin
        any_hit = 1'b1;
        next_slot = VIEW_BITS'(i);
        next_keys = held_keys[i*LEVELS+:LEVELS];
      end
    end
  end

  // DEC-1, EXT-5: the first level, from the stop level up, whose image is a key image; else the top.
  function automatic logic [2:0] first_level_of(input logic [LEVELS-1:0] keys, input logic [3:0] stop_level,
                                                input logic [2:0] top);
    first_level_of = top;
    for (int i = LEVELS - 1; i >= 0; i--) if (keys[i] && 4'(i) >= stop_level) first_level_of = 3'(i);
  endfunction

  // Chroma blocks that the answer holds already: those of the latest request for RGB.
  localparam int BLOCK_BITS = hmlfc_pkg::BLOCK_BITS;
  localparam int SITE_BITS = 2 * hmlfc_pkg::GRID_BITS + 2 * BLOCK_BITS + 4;
  logic chroma_held;
  logic [SITE_BITS-1:0] chroma_site;
  wire [BLOCK_BITS-1:0] chroma_bx = stream.chroma_444 ? bx[12:0] : bx[13:1];
  wire [BLOCK_BITS-1:0] chroma_by = stream.chroma_444 ? by[12:0] : by[13:1];
  wire [SITE_BITS-1:0] site = {row[9:0], col[9:0], chroma_bx, chroma_by, stop};

  // The request that is turned into jobs: plane and level run on while it lasts.
  logic busy, last, rgb, of_residuals, chroma_left_out;
  logic [VIEW_BITS-1:0] hit_slot;
  logic [5:0] error;
  logic [3:0] now_stop;
  logic [BLOCK_BITS-1:0] now_bx, now_by;
  logic [SITE_BITS-1:0] now_site;
  logic [2:0] first_level, level;
  logic [1:0] now_plane;
  logic begun;  // a job of the plane has left
  wire ends_plane = error != 0 || 4'(level) == now_stop;
  wire ends_request = ends_plane && (error != 0 || !rgb || now_plane == 2'd2 || (now_plane == 2'd0 && chroma_left_out));

  wire [5:0] next_error = load_error != 0 ? load_error : there ? 6'd0 : 6'(HMLFC_ERROR_BAD_REQUEST);
  logic working;
  wire view_wanted = next_valid && next_error == 0 && !any_hit && !working;
  wire candidate_used = used[candidate] || (busy && error == 0 && hit_slot == candidate);
  assign view_start = view_wanted && !candidate_used;
  assign view_row = row[9:0];
  assign view_col = col[9:0];

  assign job_valid = busy;
  always_comb begin
    job = '0;
    job.id = (hmlfc_pkg::VIEW_BITS + 3)'({hit_slot, level});
    job.plane = now_plane;
    job.bx = rgb && now_plane != 0 ? now_site[BLOCK_BITS+4+:BLOCK_BITS] : now_bx;
    job.by = rgb && now_plane != 0 ? now_site[4+:BLOCK_BITS] : now_by;
    job.first = !begun;
    job.last = ends_plane;
    job.rgb = rgb;
    job.residuals = of_residuals;
    job.answer = ends_request;
    job.tlast = last;
    job.error = error;
    if (error != 0) begin
      job.id = '0;
      job.plane = '0;
      job.residuals = 1'b0;
      job.first = 1'b1;
    end
  end
  wire emit = job_valid && job_ready;
  wire passes = any_hit || next_error != 0;
  assign next_ready = passes && (!busy || (emit && ends_request));
  wire pass = next_valid && next_ready;
  wire [2:0] next_level = residuals ? stop[2:0] : first_level_of(next_keys, stop, stream.tree_height);

  always_ff @(posedge clk) begin
    if (pass) begin
      last <= next_last;
      rgb <= plane == 2'd3;
      of_residuals <= residuals;
      error <= next_error;
      hit_slot <= next_slot;
      first_level <= next_level;
      level <= next_level;
      now_stop <= stop;
      now_bx <= bx[12:0];
      now_by <= by[12:0];
      now_site <= site;
      now_plane <= plane == 2'd3 ? 2'd0 : plane;
      begun <= 1'b0;
      chroma_left_out <= chroma_held && chroma_site == site;
    end else if (emit) begin
      level <= ends_plane ? first_level : level - 3'd1;
      begun <= !ends_plane;
      if (ends_plane) now_plane <= now_plane + 2'd1;
    end
    if (chroma_spoiled) chroma_left_out <= 1'b0;
    if (emit && rgb && error == 0 && now_plane == 2'd1) begin
      chroma_held <= 1'b1;
      chroma_site <= now_site;
    end
    if (view_wanted) slot <= candidate;  // past it where it is used
    if (view_start) begin
      working <= 1'b1;
      view_slot <= candidate;
      held[candidate] <= 1'b0;
    end
    if (view_done) begin
      working <= 1'b0;
      held[slot] <= 1'b1;
    end
    for (int i = 0; i < VIEWS; i++) begin
      if (view_start && candidate == VIEW_BITS'(i)) {held_rows[i*10+:10], held_cols[i*10+:10]} <= {view_row, view_col};
      if (view_done && slot == VIEW_BITS'(i)) held_keys[i*LEVELS+:LEVELS] <= view_keys;
      users[i*10+:10] <= users[i*10+:10] + 10'(emit && job.id[3+:VIEW_BITS] == VIEW_BITS'(i)) -
          10'(finished_valid && finished_slot == VIEW_BITS'(i));
    end
    if (!rst_n) begin
      busy <= 1'b0;
      working <= 1'b0;
      slot <= '0;
      users <= '0;
    end else begin
      busy <= pass || (busy && !(emit && ends_request));
    end
    if (!rst_n || flush) held <= '0;
    if (!rst_n || flush || chroma_spoiled) chroma_held <= 1'b0;
  end

endmodule

`default_nettype wire
