// Requests, from any state, step by step: a request that is not there gets bad_request, any gets the error of LOAD; its view is one that is held, or
// takes the place of the oldest when none of its blocks is in flight; its jobs are blocks of one plane from the first level of DEC-1 down, of RGB those
// of Y, Co and Cg, without chroma that the answer holds already.
//
// Clauses: DEC-1, EXT-5, Requests and Answers (docs/decode_unit.md)
// Engine: bmc 2
// Complete: any state in which no view is held twice, and one step from it; the queue of requests may do anything (proof fifo).
// Fault: hmlfc_requests.sv / next[63:61] == 0 / 1'b1
// Fault: hmlfc_requests.sv / keys[i] && 4'(i) >= stop_level / keys[i] && 4'(i) > stop_level
// Fault: hmlfc_requests.sv / bx[12:0] : bx[13:1] / bx[13:1] : bx[13:1]
// Fault: hmlfc_requests.sv / users[32'(oldest)*10+:10] == 0 / users[32'(slot)*10+:10] == 0
// Fault: hmlfc_requests.sv / if (chroma_spoiled) chroma_left_out <= 1'b0; / if (chroma_spoiled) chroma_left_out <= 1'b1;
`include "hmlfc_tables.svh"
`include "inside.svh"

// In the place of the queue.
module hmlfc_fifo #(parameter integer WIDTH = 8, parameter integer DEPTH = 4) (
  input logic clk, input logic rst_n, input logic in_valid, output logic in_ready, input logic [WIDTH-1:0] in_data, output logic out_valid,
  input logic out_ready, output logic [WIDTH-1:0] out_data, output logic [$clog2(DEPTH):0] count
);
  (* anyseq *) logic [WIDTH+1:0] any;
  wire [WIDTH+2:0] given = {rst_n, in_valid, out_ready, in_data};
  assign {in_ready, out_valid, out_data} = any;
endmodule

module prove_requests_jobs #(
  parameter integer VIEWS = 16,
  localparam integer V = $clog2(VIEWS)
) (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic enable, input logic [5:0] load_error, input logic flush,
  input logic s_valid, input logic [63:0] s_data, input logic s_last, input logic view_done, input logic [7:0] view_keys, input logic job_ready,
  input logic chroma_spoiled, input logic finished_valid, input logic [V-1:0] finished_slot
);
  localparam integer J = hmlfc_pkg::JOB_BITS;
  logic         s_ready, view_start, job_valid;
  logic [V-1:0] view_slot;
  logic [9:0]   view_row, view_col;
  logic [J-1:0] job_bits;
  hmlfc_pkg::job_t job, expected;
  hmlfc_pkg::config_t stream;
  assign job = job_bits;
  assign stream = stream_bits;
  hmlfc_requests #(.VIEWS(VIEWS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .enable(enable), .load_error(load_error), .flush(flush), .s_valid(s_valid), .s_ready(s_ready),
    .s_data(s_data), .s_last(s_last), .view_start(view_start), .view_row(view_row), .view_col(view_col), .view_slot(view_slot),
    .view_done(view_done), .view_keys(view_keys), .job_valid(job_valid), .job_ready(job_ready), .job(job_bits),
    .chroma_spoiled(chroma_spoiled), .finished_valid(finished_valid), .finished_slot(finished_slot));
  `SEEN(67, \dut.waiting.any )
  `SEEN(68, \dut.waiting.given )
  `SEEN(VIEWS, \dut.held )
  `SEEN(V, \dut.slot )
  `SEEN(VIEWS*10, \dut.held_rows )
  `SEEN(VIEWS*10, \dut.held_cols )
  `SEEN(VIEWS*8, \dut.held_keys )
  `SEEN(VIEWS*10, \dut.users )
  `SEEN(1, \dut.chroma_held )
  `SEEN(50, \dut.chroma_site )
  `SEEN(1, \dut.busy )
  `SEEN(1, \dut.last )
  `SEEN(1, \dut.rgb )
  `SEEN(1, \dut.of_residuals )
  `SEEN(1, \dut.hit )
  `SEEN(1, \dut.chroma_left_out )
  `SEEN(V, \dut.hit_slot )
  `SEEN(6, \dut.error )
  `SEEN(4, \dut.now_stop )
  `SEEN(13, \dut.now_bx )
  `SEEN(13, \dut.now_by )
  `SEEN(50, \dut.now_site )
  `SEEN(3, \dut.first_level )
  `SEEN(3, \dut.level )
  `SEEN(2, \dut.now_plane )
  `SEEN(1, \dut.begun )
  `SEEN(1, \dut.working )

  // The next request (Requests).
  wire         next_valid = \dut.waiting.any [65];
  wire         next_last = \dut.waiting.any [64];
  logic [2:0]  zero;
  logic        residuals;
  logic [3:0]  stop;
  logic [1:0]  plane;
  logic [14:0] by, bx;
  logic [11:0] col, row;
  assign {zero, residuals, stop, plane, by, bx, col, row} = \dut.waiting.any [63:0];
  wire         chroma = plane == 1 || plane == 2;
  wire         there = row < stream.rows && col < stream.cols && bx < (chroma ? stream.chroma.blocks_x : stream.luma.blocks_x) &&
                       by < (chroma ? stream.chroma.blocks_y : stream.luma.blocks_y) && stop <= stream.tree_height && zero == 0 &&
                       !(residuals && plane == 3);
  wire [12:0]  chroma_bx = stream.chroma_444 ? bx : bx / 2;
  wire [12:0]  chroma_by = stream.chroma_444 ? by : by / 2;
  wire [49:0]  site = {row[9:0], col[9:0], chroma_bx, chroma_by, stop};
  // Views that are held.
  logic        twice, any_hit;
  logic [V-1:0] next_slot;
  logic [7:0]  next_keys;
  integer      i, k;
  always @* begin
    {twice, any_hit} = 2'b00;
    next_slot = 0;
    next_keys = 8'd0;
    for (i = 0; i < VIEWS; i = i + 1) begin
      for (k = 0; k < i; k = k + 1) if (\dut.held [i] && \dut.held [k] && \dut.held_rows [10*i +: 10] == \dut.held_rows [10*k +: 10] &&
        \dut.held_cols [10*i +: 10] == \dut.held_cols [10*k +: 10]) twice = 1'b1;
      if (\dut.held [i] && {\dut.held_rows [10*i +: 10], \dut.held_cols [10*i +: 10]} == site[49:30]) begin
        any_hit = 1'b1;
        next_slot = i;
        next_keys = \dut.held_keys [8*i +: 8];
      end
    end
  end
  // The lowest level of a key image from the stop level on, or the top: of the next request, and of the one whose view is done.
  logic [2:0]  next_level, view_level;
  logic        found, view_found;
  always @* begin
    next_level = stream.tree_height;
    view_level = stream.tree_height;
    {found, view_found} = 2'b00;
    for (i = 0; i < 8; i = i + 1) begin
      if (!found && next_keys[i] && i >= stop) {found, next_level} = {1'b1, i[2:0]};
      if (!view_found && view_keys[i] && i >= \dut.now_stop ) {view_found, view_level} = {1'b1, i[2:0]};
    end
    if (residuals) next_level = stop;
    if (\dut.of_residuals ) view_level = \dut.now_stop ;
  end

  wire         bad = \dut.error != 0;
  wire         plane_ends = bad || \dut.level == \dut.now_stop ;
  wire         ends = bad || (plane_ends && (!\dut.rgb || \dut.now_plane == 2 || (\dut.now_plane == 0 && \dut.chroma_left_out )));
  wire         emit = job_valid && job_ready;
  wire         takes = !\dut.busy || (emit && ends);
  wire [V-1:0] oldest = \dut.slot + 1'b1;
  wire         of_chroma = \dut.rgb && \dut.now_plane != 0;
  always @* begin
    expected = '0;
    {expected.rgb, expected.tlast, expected.error, expected.first, expected.last, expected.answer} =
      {\dut.rgb , \dut.last , \dut.error , bad || !\dut.begun , plane_ends, ends};
    {expected.bx, expected.by} = of_chroma ? \dut.now_site [29:4] : {\dut.now_bx , \dut.now_by };
    if (!bad) begin
      expected.id = {\dut.hit_slot , \dut.level };
      {expected.plane, expected.residuals} = {\dut.now_plane , \dut.of_residuals };
    end
  end

  logic        was = 1'b0, was_reset = 1'b0, was_flush = 1'b0, n_held, n_busy, n_last, n_rgb, n_residuals, n_hit, n_left_out, n_begun, n_working;
  logic [VIEWS-1:0] next_held;
  logic [VIEWS*10-1:0] next_rows, next_cols, next_users;
  logic [VIEWS*8-1:0] next_held_keys;
  logic [V-1:0] n_slot, n_hit_slot, n_view_slot;
  logic [49:0] n_chroma_site, n_site;
  logic [5:0]  n_error;
  logic [3:0]  n_stop;
  logic [12:0] n_bx, n_by;
  logic [2:0]  n_first_level, n_level;
  logic [1:0]  n_plane;
  always @(posedge clk) begin
    was <= rst_n;
    was_reset <= !rst_n;
    was_flush <= flush || !rst_n;
    {next_held, next_rows, next_cols, next_held_keys, n_slot, n_view_slot} <= {\dut.held , \dut.held_rows , \dut.held_cols , \dut.held_keys , \dut.slot , view_slot};
    {n_held, n_chroma_site, n_working} <= {\dut.chroma_held , \dut.chroma_site , \dut.working };
    {n_last, n_rgb, n_residuals, n_hit, n_hit_slot, n_error} <= {\dut.last , \dut.rgb , \dut.of_residuals , \dut.hit , \dut.hit_slot , \dut.error };
    {n_stop, n_bx, n_by, n_site, n_first_level} <= {\dut.now_stop , \dut.now_bx , \dut.now_by , \dut.now_site , \dut.first_level };
    {n_level, n_plane, n_begun, n_left_out} <= {\dut.level , \dut.now_plane , \dut.begun , \dut.chroma_left_out };
    n_busy <= next_valid || !takes;
    if (next_valid && takes) begin
      {n_last, n_rgb, n_residuals, n_hit, n_hit_slot} <= {next_last, plane == 2'd3, residuals, any_hit, next_slot};
      n_error <= load_error != 0 ? load_error : there ? 6'd0 : 6'(HMLFC_ERROR_BAD_REQUEST);
      {n_stop, n_bx, n_by, n_site} <= {stop, bx[12:0], by[12:0], site};
      {n_first_level, n_level, n_plane, n_begun} <= {next_level, next_level, plane == 2'd3 ? 2'd0 : plane, 1'b0};
      n_left_out <= \dut.chroma_held && \dut.chroma_site == site;
    end else if (emit) begin
      n_level <= plane_ends ? \dut.first_level : \dut.level - 3'd1;
      n_plane <= \dut.now_plane + {1'b0, plane_ends};
      n_begun <= !plane_ends;
    end
    if (emit && of_chroma && !bad && \dut.now_plane == 1) {n_held, n_chroma_site} <= {1'b1, \dut.now_site };
    if (chroma_spoiled) {n_held, n_left_out} <= 2'b00;
    for (i = 0; i < VIEWS; i = i + 1) begin
      next_users[10*i +: 10] <= \dut.users [10*i +: 10] + {9'd0, emit && job.id[3 +: V] == i} - {9'd0, finished_valid && finished_slot == i};
      if (view_start && oldest == i) {next_held[i], next_rows[10*i +: 10], next_cols[10*i +: 10]} <= {1'b0, \dut.now_site [49:30]};
      if (view_done && \dut.slot == i) {next_held[i], next_held_keys[8*i +: 8]} <= {1'b1, view_keys};
    end
    if (view_start) {n_working, n_slot, n_view_slot} <= {1'b1, oldest, oldest};
    if (view_done) {n_working, n_hit, n_hit_slot, n_first_level, n_level} <= {2'b01, \dut.slot , view_level, view_level};
  end
  always @* begin
    assume (!twice && \dut.now_plane != 3);
    // A view is done while the request that needs it waits, and the loader flushes while none does.
    if (view_done) assume (\dut.working && \dut.busy && !bad && !\dut.hit );
    if (\dut.working ) assume (\dut.busy && !bad && !\dut.hit );
    assert (\dut.waiting.given == {rst_n, s_valid && enable, takes, s_last, s_data} && s_ready == (enable && \dut.waiting.any [66]));
    assert (job_valid == (\dut.busy && (bad || \dut.hit )));
    if (job_valid) assert (job == expected);
    assert (view_start == (\dut.busy && !bad && !\dut.hit && !\dut.working && \dut.users [10*oldest +: 10] == 0));
    assert ({view_row, view_col} == \dut.now_site [49:30]);
    if (was_reset) assert (!\dut.busy && !\dut.working && \dut.slot == 0 && \dut.users == 0);
    if (was_flush) assert (\dut.held == 0 && !\dut.chroma_held );
    if (was) begin
      if (!was_flush) assert ({\dut.held , \dut.chroma_held } == {next_held, n_held});
      assert ({\dut.held_rows , \dut.held_cols , \dut.held_keys , \dut.users } == {next_rows, next_cols, next_held_keys, next_users});
      assert ({\dut.slot , view_slot, \dut.working , \dut.busy , \dut.chroma_site } == {n_slot, n_view_slot, n_working, n_busy, n_chroma_site});
      assert ({\dut.last , \dut.rgb , \dut.of_residuals , \dut.error , \dut.now_stop } == {n_last, n_rgb, n_residuals, n_error, n_stop});
      assert ({\dut.now_bx , \dut.now_by , \dut.now_site , \dut.chroma_left_out } == {n_bx, n_by, n_site, n_left_out});
      assert ({\dut.now_plane , \dut.begun , \dut.hit , \dut.first_level , \dut.level } == {n_plane, n_begun, n_hit, n_first_level, n_level});
      if (\dut.hit ) assert (\dut.hit_slot == n_hit_slot);
    end
  end
endmodule
