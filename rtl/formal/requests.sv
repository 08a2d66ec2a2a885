// Each request becomes jobs of which exactly one, the last, carries `answer`; it carries the request's tlast. At most
// three requests are inside. A job that is offered does not change until it is taken, but that spoiled chroma may add
// jobs behind it. The jobs of a plane go down level by level and end at the stop level, so a request ends after at most
// 3 * 8 jobs once its view is there; one for residuals is one job, of its stop level.
//
// Clauses: DEC-1, Requests and Answers (docs/decode_unit.md)
// Engine: induction 2 8
// Complete: the stream's configuration and the error of LOAD are any constants; `flush` comes only while no request is
// held, and key images are of the tree's levels.
module prove_requests #(
  parameter integer VIEWS = 4  // of the unit's 8: slots differ in number alone, and their pairs make the proof long
) (
  input logic clk, input logic rst_n, input logic enable, input logic flush, input logic s_valid,
      input logic [63:0] s_data,
  input logic s_last, input logic view_done, input logic [7:0] view_keys, input logic job_ready,
      input logic chroma_spoiled,
  input logic finished_valid, input logic [$clog2(VIEWS)-1:0] finished_slot
);
  (* anyconst *) logic [10:0] rows;
  (* anyconst *) logic [10:0] cols;
  (* anyconst *) logic [13:0] blocks;
  (* anyconst *) logic [2:0] tree_height;
  (* anyconst *) logic chroma_444;
  (* anyconst *) logic [5:0] load_error;
  hmlfc_pkg::config_t stream;
  always @* begin
    stream = '0;
    stream.rows = rows;
    stream.cols = cols;
    stream.tree_height = tree_height;
    stream.chroma_444 = chroma_444;
    stream.luma.blocks_x = blocks;
    stream.luma.blocks_y = blocks;
    stream.chroma.blocks_x = blocks;
    stream.chroma.blocks_y = blocks;
  end
  logic s_ready, view_start, job_valid;
  logic [$clog2(VIEWS)-1:0] view_slot;
  logic [9:0] view_row, view_col;
  logic [hmlfc_pkg::JOB_BITS-1:0] job_bits;
  hmlfc_pkg::job_t job;
  assign job = job_bits;
  hmlfc_requests #(.VIEWS(VIEWS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream), .enable(enable), .load_error(load_error), .flush(flush),
    .s_valid(s_valid), .s_ready(s_ready), .s_data(s_data), .s_last(s_last), .view_start(view_start),
    .view_row(view_row), .view_col(view_col), .view_slot(view_slot), .view_done(view_done), .view_keys(view_keys),
    .job_valid(job_valid), .job_ready(job_ready), .job(job_bits), .chroma_spoiled(chroma_spoiled),
    .finished_valid(finished_valid), .finished_slot(finished_slot));
  (* hierconn *) wire \dut.busy ;
  (* hierconn *) wire \dut.working ;
  (* hierconn *) wire \dut.begun ;
  (* hierconn *) wire \dut.last ;
  (* hierconn *) wire \dut.next_valid ;
  (* hierconn *) wire \dut.next_last ;
  (* hierconn *) wire [1:0] \dut.waiting.count ;
  (* hierconn *) wire [1:0] \dut.waiting.taken ;
  (* hierconn *) wire [64:0] \dut.waiting.storage.words[0] ;
  (* hierconn *) wire [64:0] \dut.waiting.storage.words[1] ;
  (* hierconn *) wire \dut.rgb ;
  (* hierconn *) wire \dut.of_residuals ;
  (* hierconn *) wire [5:0] \dut.error ;
  (* hierconn *) wire [$clog2(VIEWS)-1:0] \dut.hit_slot ;
  (* hierconn *) wire \dut.any_hit ;
  (* hierconn *) wire [5:0] \dut.next_error ;
  (* hierconn *) wire [2:0] \dut.level ;
  (* hierconn *) wire [2:0] \dut.first_level ;
  (* hierconn *) wire [3:0] \dut.now_stop ;
  (* hierconn *) wire [VIEWS-1:0] \dut.held ;
  (* hierconn *) wire [$clog2(VIEWS)-1:0] \dut.slot ;
  (* hierconn *) wire [8*VIEWS-1:0] \dut.held_keys ;
  (* hierconn *) wire [1:0] \dut.now_plane ;
  (* hierconn *) wire [10*VIEWS-1:0] \dut.held_rows ;
  (* hierconn *) wire [10*VIEWS-1:0] \dut.held_cols ;
  wire [19:0] now_view = {view_row, view_col};
  logic [20*VIEWS-1:0] held_views;
  always @* for (int i = 0; i < VIEWS; i++) held_views[20*i+:20] =
      {\dut.held_rows [10*i+:10], \dut.held_cols [10*i+:10]};
  wire [19:0] working_view = held_views[20*\dut.slot +:20];
  wire [8:0] beyond = 9'h1fe << tree_height;  // levels that the tree has not
  wire [3:0] first_level = {1'b0, \dut.first_level };
  wire [3:0] level = {1'b0, \dut.level };

  logic        started = 1'b0;
  logic [1:0]  open;  // requests taken, less jobs with `answer`
  logic [2:0]  lasts;  // tlast of the requests inside, the oldest at bit 0
  wire         stored_first = \dut.waiting.taken [0] ? \dut.waiting.storage.words[1] [64] :
      \dut.waiting.storage.words[0] [64];
  wire         stored_second = \dut.waiting.taken [0] ? \dut.waiting.storage.words[0] [64] :
      \dut.waiting.storage.words[1] [64];
  wire         emit = job_valid && job_ready;
  wire  [1:0]  left = open - {1'b0, emit && job.answer};
  wire  [3:0]  stop = \dut.now_stop ;
  logic        waiting;
  logic        waiting_spoiled;
  logic [hmlfc_pkg::JOB_BITS-1:0] waiting_job;
  logic        same_plane;  // the job before was of the same plane of the same request, of level above + 1
  logic [3:0]  above;
  always @(posedge clk) begin
    started <= 1'b1;
    if (!rst_n) open <= 2'd0;
    else open <= left + {1'b0, s_valid && s_ready};
    if (emit && job.answer) lasts <= lasts >> 1;
    if (s_valid && s_ready && left == 0) lasts[0] <= s_last;
    if (s_valid && s_ready && left == 1) lasts[1] <= s_last;
    if (s_valid && s_ready && left == 2) lasts[2] <= s_last;
    waiting <= rst_n && job_valid && !job_ready;
    waiting_job <= job_bits;
    waiting_spoiled <= chroma_spoiled;
    if (!rst_n) same_plane <= 1'b0;
    else if (emit) same_plane <= !job.last;
    if (emit) above <= {1'b0, job.id[2:0]} - 4'd1;
  end

  always @* begin
    if (!started) assume (!rst_n);
    if (started) begin
      if (view_done) assume (\dut.working );
      if (view_done) assume ((view_keys & beyond[7:0]) == 0);
      for (int i = 0; i < VIEWS; i++) begin
        if (\dut.held [i]) assert ((\dut.held_keys [8*i+:8] & beyond[7:0]) == 0);
        for (int j = 0; j < i; j++) if (\dut.held [i] &&
            \dut.held [j]) assert (held_views[20*i+:20] != held_views[20*j+:20]);
      end
      if (flush) assume (!\dut.busy && !\dut.next_valid );
      assert (\dut.waiting.count <= 2 && open == {1'b0, \dut.busy } + \dut.waiting.count );
      if (\dut.busy ) assert (\dut.last == lasts[0]);
      if (\dut.next_valid ) assert (\dut.next_last == lasts[\dut.busy ] && stored_first == lasts[\dut.busy ]);
      if (\dut.waiting.count == 2) assert (stored_second == lasts[{1'b0, \dut.busy } + 2'd1]);
      if (\dut.working ) assert (\dut.next_valid && \dut.next_error == 0 && !\dut.any_hit && !\dut.held [\dut.slot ] &&
          working_view == now_view);
      if (\dut.busy ) assert (\dut.now_plane != 3);
      if (\dut.busy && \dut.error == 0) begin
        assert (stop <= {1'b0, tree_height});
        assert (level >= stop && level <= first_level && first_level <= {1'b0, tree_height});
        if (\dut.of_residuals ) assert (!\dut.rgb && first_level == stop);
        assert (\dut.held [\dut.hit_slot ]);  // no view takes the place of one whose jobs leave
      end
      if (job_valid) begin
        assert (\dut.busy && job.tlast == lasts[0]);
        if (job.answer) assert (job.last);
        if (job.residuals) assert (job.first && job.last && job.answer && !job.rgb);
        if (job.error != 0) assert (job.answer);
        if (job.error == 0) begin
          assert ({1'b0, job.id[2:0]} >= stop && {1'b0, job.id[2:0]} <= {1'b0, tree_height});
          assert (job.last == ({1'b0, job.id[2:0]} == stop));
          assert (job.plane != 3);
        end
        assert (job.first == !same_plane || job.error != 0);
        if (same_plane && job.error == 0) assert ({1'b0, job.id[2:0]} == above);
      end
      if (\dut.busy && same_plane)
        assert (\dut.begun && level == above && above >= stop && above < {1'b0, tree_height});
      if (\dut.busy && !same_plane) assert (!\dut.begun && (\dut.error != 0 || level == first_level));
      if (!\dut.busy ) assert (!same_plane);
    end
  end
  always @(posedge clk) begin
    if (started && $past(started) && waiting)
      assert (job_valid && (job_bits ^ waiting_job) == (waiting_spoiled && waiting_job[7] && !job.answer ?
          hmlfc_pkg::JOB_BITS'(1) << 7 : hmlfc_pkg::JOB_BITS'(0)));
  end
endmodule
