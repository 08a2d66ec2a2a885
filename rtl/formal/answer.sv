// Each block that ends a request gives exactly one answer, in order, with its own status and tlast: blocks that end
// requests are taken and answers given in equal numbers but for those inside, which is proved of any one block that is
// followed; an answer does not change while it waits. For a request of one plane the answer is the block's samples, or,
// for residuals, its residuals, 0 where it has none. For RGB the colour transform gets the samples of Y and, by COL-3,
// those of Co and Cg at its pixels, each of the latest last block of its plane, and the answer is what the transform
// gives for them two clocks later (proof colour); its status is the first error of Y, Co and Cg. With an error the
// samples are 0. Chroma that is kept and met a bus error is told. BLOCK_LOG2 = 1, MAX_DEPTH = 8; any stalls.
//
// Clauses: Answers (docs/decode_unit.md), COL-2 for its place in the order, COL-3
// Engine: induction 1 3
// Complete: the block that is followed is bound to the stages' registers, so the induction needs no reachability.
`include "hmlfc_tables.svh"
`include "follow.svh"
module prove_answer #(
  parameter integer BLOCK_LOG2 = 1,
  parameter integer MAX_DEPTH = 8,
  localparam integer B = 1 << BLOCK_LOG2,
  localparam integer N = B * B,
  localparam integer S = MAX_DEPTH + 1,  // bits of a sample
  localparam integer V = MAX_DEPTH + 2,  // of a residual
  localparam integer P = N * S,          // of a plane
  localparam integer L = 3 * N * 16      // of an answer
) (
  input logic clk, input logic rst_n, input logic in_valid, input logic [hmlfc_pkg::JOB_BITS-1:0] in_job,
      input logic [5:0] in_error,
  input logic [P-1:0] in_sample, input logic in_has_residual, input logic [N*V-1:0] in_residual, input logic out_ready,
      input logic [3:0] depth, input logic chroma_444
);
  hmlfc_pkg::job_t job;
  assign job = in_job;
  logic         in_ready, out_valid, out_last, chroma_spoiled;
  logic [L-1:0] out_data;
  logic [5:0]   out_error;
  hmlfc_answer #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH)) dut (
    .clk(clk), .rst_n(rst_n), .depth(depth), .chroma_444(chroma_444), .in_valid(in_valid), .in_ready(in_ready),
    .in_job(job), .in_error(in_error), .in_sample(in_sample), .in_has_residual(in_has_residual),
    .in_residual(in_residual), .chroma_spoiled(chroma_spoiled), .out_valid(out_valid), .out_ready(out_ready),
    .out_data(out_data), .out_error(out_error), .out_last(out_last));
  (* hierconn *) wire [3:1] \dut.valid ;
  (* hierconn *) wire [3:1] \dut.last ;
  (* hierconn *) wire \dut.advance ;
  (* hierconn *) wire \dut.advance_out ;
  (* hierconn *) wire [3:1] \dut.rgb ;
  (* hierconn *) wire [5:0] \dut.status_1 ;
  (* hierconn *) wire [5:0] \dut.status_2 ;
  (* hierconn *) wire [5:0] \dut.status_3 ;
  (* hierconn *) wire [P-1:0] \dut.y_1 ;
  (* hierconn *) wire [P-1:0] \dut.co_1 ;
  (* hierconn *) wire [P-1:0] \dut.cg_1 ;
  (* hierconn *) wire [P-1:0] \dut.y_2 ;
  (* hierconn *) wire [P-1:0] \dut.y_3 ;
  (* hierconn *) wire [N-1:0] \dut.signs_1 ;
  (* hierconn *) wire [N-1:0] \dut.signs_2 ;
  (* hierconn *) wire [N-1:0] \dut.signs_3 ;
  (* hierconn *) wire [L-1:0] \dut.lanes_3 ;
  (* hierconn *) wire [L+6:0] \dut.g_block.out.skid ;

  // The latest last blocks of requests for RGB: {error, samples}, and the place of that of Y.
  wire         kept = in_valid && in_ready && job.rgb && job.last;
  wire  [P+5:0] block = {in_error, in_sample};
  logic [P+5:0] y_kept, co_kept, cg_kept;
  logic [1:0]  place_kept;
  always @(posedge clk) begin
    if (kept && job.plane == 0) {y_kept, place_kept} <= {block, job.by[0], job.bx[0]};
    if (kept && job.plane == 1) co_kept <= block;
    if (kept && job.plane == 2) cg_kept <= block;
  end
  (* hierconn *) wire [P-1:0] \dut.held_y ;
  (* hierconn *) wire [P-1:0] \dut.held_co ;
  (* hierconn *) wire [P-1:0] \dut.held_cg ;
  (* hierconn *) wire [5:0] \dut.error_y ;
  (* hierconn *) wire [5:0] \dut.error_co ;
  (* hierconn *) wire [5:0] \dut.error_cg ;
  (* hierconn *) wire [1:0] \dut.corner ;

  // Chroma at the pixels: that of pixel (x, y) of a block at (bx, by) is sample ((B bx + x) / 2, (B by + y) / 2) of the
  // plane.
  function automatic [P-1:0] pixels_of(input [P-1:0] plane, input by, input bx);
    for (integer k = 0; k < N; k = k + 1)
      pixels_of[S*k +: S] = plane >> (S * (B * ((B * by + k / B) / 2) + (B * bx + k % B) / 2));
  endfunction
  function automatic [P-1:0] pixels(input [P-1:0] plane, input [1:0] place, input full);
    pixels = full ? plane :
        place[1] ? (place[0] ? pixels_of(plane, 1'b1, 1'b1) : pixels_of(plane, 1'b1, 1'b0)) :
        place[0] ? pixels_of(plane, 1'b0, 1'b1) : pixels_of(plane, 1'b0, 1'b0);
  endfunction

  // The values of a request for one plane: {their upper bits, the others}.
  wire [N*V-1:0] values;
  generate
    for (genvar i = 0; i < N; i = i + 1) begin : g_value
      wire [V-1:0] value = !job.residuals ? {in_sample[S*i+S-1], in_sample[S*i +: S]} : in_has_residual ?
          in_residual[V*i +: V] : {V{1'b0}};
      assign {values[P+i], values[S*i +: S]} = value;
    end
  endgenerate

  // What a block that ends a request becomes: {signs, cg, co, rgb, tlast, error, samples}.
  localparam integer E = 3 * P + N + 8;
  wire         put = in_valid && in_ready && job.answer;
  wire         take = out_valid && out_ready;
  wire [P+5:0] y = job.plane == 0 ? block : y_kept;
  wire [P+5:0] cg = job.plane == 2 ? block : cg_kept;
  wire [1:0]   place = job.plane == 0 ? {job.by[0], job.bx[0]} : place_kept;
  wire [5:0]   first_error = y[P +: 6] != 0 ? y[P +: 6] : co_kept[P +: 6] != 0 ? co_kept[P +: 6] : cg[P +: 6];
  wire [E-1:0] entry = {values[P +: N], pixels(cg[P-1:0], place, chroma_444),
      pixels(co_kept[P-1:0], place, chroma_444), job.rgb, job.tlast,
                        job.rgb ? {first_error, y[P-1:0]} : {in_error, values[P-1:0]}};

  // How many are in front of the stages from the oldest on: the slice's two registers, stages 3 to 1.
  wire [2:0] at_skid = {2'd0, out_valid};
  wire [2:0] at_3 = at_skid + {2'd0, !\dut.advance_out };
  wire [2:0] at_2 = at_3 + {2'd0, \dut.valid [3]};
  wire [2:0] at_1 = at_2 + {2'd0, \dut.valid [2]};

  // The block that is followed, and what the transform gave for it.
  `FOLLOW(E, entry)
  wire  [E-1:0] e = followed;
  logic [L-1:0] transformed;
  always @(posedge clk) if (\dut.valid [3] && \dut.advance_out && ahead == at_3) transformed <= \dut.lanes_3 ;
  reg [L-1:0] lanes;
  always @* begin
    lanes = e[P+7] ? transformed : {L{1'b0}};
    if (!e[P+7]) for (integer i = 0; i < N; i = i + 1) lanes[16*i +: 16] = {{(16-S){e[3*P+8+i]}}, e[S*i +: S]};
    if (e[P +: 6] != 0) lanes = {L{1'b0}};
  end

  logic         waiting;
  logic [L+6:0] waiting_answer;
  always @(posedge clk) begin
    waiting <= started && rst_n && out_valid && !out_ready;
    waiting_answer <= {out_last, out_error, out_data};
  end

  always @* begin
    assume (job.plane != 3);
    if (job.rgb) assume (!job.residuals);
    if (job.rgb && job.answer) assume (job.last && job.plane != 1);  // a request's planes come as Y, or Y, Co, Cg
    if (!started) begin
      assume (!rst_n);
      assume (co_kept == {\dut.error_co , \dut.held_co } && cg_kept == {\dut.error_cg , \dut.held_cg });
      assume (y_kept == {\dut.error_y , \dut.held_y } && place_kept == \dut.corner );
    end else begin
      assert (co_kept == {\dut.error_co , \dut.held_co } && cg_kept == {\dut.error_cg , \dut.held_cg });
      assert (y_kept == {\dut.error_y , \dut.held_y } && place_kept == \dut.corner );
      assert (held == at_1 + {2'd0, \dut.valid [1]});
      assert (held <= 5);
      assert (chroma_spoiled == (kept && job.plane != 0 && in_error == HMLFC_ERROR_BUS_ERROR));
      if (!\dut.advance_out ) assert (out_valid);
      if (waiting) assert (out_valid && {out_last, out_error, out_data} == waiting_answer);
      if (following) assert (ahead < held);
      if (following && out_valid && ahead == 0) assert ({out_last, out_error, out_data} == {e[P+6:P], lanes});
      if (following && !\dut.advance_out && ahead == at_skid) assert (\dut.g_block.out.skid == {e[P+6:P], lanes});
      if (following && \dut.valid [3] && ahead == at_3)
        assert ({\dut.rgb [3], \dut.last [3], \dut.status_3 } == e[P +: 8] &&
            (e[P+7] || {\dut.signs_3 , \dut.y_3 } == {e[3*P+8 +: N], e[P-1:0]}));
      if (following && \dut.valid [2] && ahead == at_2)
        assert ({\dut.rgb [2], \dut.last [2], \dut.status_2 } == e[P +: 8] &&
            (e[P+7] || {\dut.signs_2 , \dut.y_2 } == {e[3*P+8 +: N], e[P-1:0]}));
      if (following && \dut.valid [1] && ahead == at_1) begin
        assert ({\dut.rgb [1], \dut.last [1], \dut.status_1 , \dut.y_1 } == e[P+7:0]);
        if (e[P+7]) assert ({\dut.cg_1 , \dut.co_1 } == e[P+8 +: 2*P]);
        else assert (\dut.signs_1 == e[3*P+8 +: N]);
      end
    end
  end
endmodule
