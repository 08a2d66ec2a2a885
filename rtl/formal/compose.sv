// Each block that enters leaves once and in order with its own job, residual and error, whatever is asked of the output
// and whenever its windows come: this is proved of any one block that is followed; a block that leaves does not change
// while it waits; each block takes the windows it asked for, each once, those of B in the order first, second; and no
// window passes without a block. The error is that of the level before, or else the first of the block's own, of its
// first and of its second window. The trace's prediction is that of the sum. The first block after a reset begins a
// chain. BLOCK_LOG2 = 1, MAX_DEPTH = 8.
//
// Clauses: DEC-3 for its order, DEC-7, CNV-7, MOT-10
// Engine: induction 1 6
// Cut: interpolate reconstruct
// Complete: the block that is followed is bound to the stages' registers, so the induction needs no reachability.
`include "follow.svh"
module prove_compose #(
  parameter integer BLOCK_LOG2 = 1,
  parameter integer MAX_DEPTH = 8,
  localparam integer R = (MAX_DEPTH + 2) << (2 * BLOCK_LOG2),  // bits of a residual
  localparam integer P = (MAX_DEPTH + 1) << (2 * BLOCK_LOG2),  // of samples
  localparam integer J = hmlfc_pkg::PENDING_BITS,
  localparam integer E = 6 + R + J  // {error, residual, pending}
) (
  input logic clk, input logic rst_n, input logic in_valid, input logic [J-1:0] in_pending,
      input logic [R-1:0] in_residual,
  input logic a_valid, input logic [5:0] a_error, input logic b_valid, input logic [5:0] b_error, input logic out_ready
);
  hmlfc_pkg::pending_t pending;
  assign pending = in_pending;
  logic        in_ready, a_ready, b_ready, out_valid;
  logic [J-1:0] out_pending;
  logic [5:0]   out_error;
  logic [R-1:0] out_residual;
  logic [P-1:0] out_prediction;
  hmlfc_compose #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH)) dut (
    .clk(clk), .rst_n(rst_n), .depth(4'd8), .in_valid(in_valid), .in_ready(in_ready), .in_pending(pending),
    .in_residual(in_residual), .a_valid(a_valid), .a_ready(a_ready), .a_error(a_error), .a_window('0),
    .b_valid(b_valid), .b_ready(b_ready), .b_error(b_error), .b_window('0), .out_valid(out_valid),
    .out_ready(out_ready), .out_pending(out_pending), .out_error(out_error), .out_sample(), .out_residual(out_residual),
    .out_reference(), .out_prediction(out_prediction));
  (* hierconn *) wire [7:1] \dut.valid ;
  (* hierconn *) wire [7*J-1:0] \dut.pendings ;
  (* hierconn *) wire [7*R-1:0] \dut.residuals ;
  (* hierconn *) wire [7*6-1:0] \dut.errors ;
  (* hierconn *) wire \dut.kept_valid ;
  (* hierconn *) wire [5:0] \dut.kept_error ;
  (* hierconn *) wire [5:0] \dut.chain_error ;
  (* hierconn *) wire [P-1:0] \dut.reconstruct.prediction ;
  always @* assert (out_prediction == \dut.reconstruct.prediction );

  wire put = in_valid && in_ready;
  wire take = out_valid && out_ready;

  // Windows that the block in front needs and has not taken: of A; of B.
  wire needs_first = pending.key || pending.motion;
  wire needs_a = needs_first && !pending.first_from_b;
  wire [1:0] needs_b = {1'b0, pending.two} + {1'b0, needs_first && pending.first_from_b};
  logic [1:0] taken_b;
  always @(posedge clk) begin
    if (!rst_n || put) taken_b <= 2'd0;
    else taken_b <= taken_b + {1'b0, b_valid && b_ready};
  end

  // The error of the block itself: of its first window, which may have come through B before the second.
  logic [5:0] b_taken_error;
  always @(posedge clk) if (b_valid && b_ready) b_taken_error <= b_error;
  wire [5:0] first_error = needs_a ? a_error : !needs_first ? 6'd0 : pending.two ? b_taken_error : b_error;
  wire [5:0] own_error = pending.job.error != 0 ? pending.job.error : first_error != 0 ? first_error : pending.two ?
      b_error : 6'd0;

  wire [E-1:0] entry = {own_error, in_residual, in_pending};
  `FOLLOW(E, entry)

  // The error of the level before.
  logic       any;
  logic [5:0] before;
  always @(posedge clk) begin
    any <= rst_n && (any || take);
    if (take) before <= out_error;
  end
  hmlfc_pkg::pending_t leaving;
  assign leaving = followed[J-1:0];
  wire [5:0] error = !leaving.job.first && before != 0 ? before : followed[J+R +: 6];

  logic         waiting, offered;
  logic [E-1:0] waiting_block;
  logic [J-1:0] offered_pending;
  always @(posedge clk) begin
    waiting <= started && rst_n && out_valid && !out_ready;
    waiting_block <= {out_error, out_residual, out_pending};
    offered <= rst_n && in_valid && !in_ready;
    offered_pending <= in_pending;
  end

  hmlfc_pkg::pending_t first;  // its bit alone
  always @* begin
    first = {J{1'b0}};
    first.job.first = 1'b1;
  end

  // Each stage but the last, with the number of blocks in front of its own.
  wire [2:0] at[6:0];
  assign at[6] = {2'd0, out_valid};
  generate
    for (genvar i = 6; i >= 1; i = i - 1) begin : g_stage
      assign at[i-1] = at[i] + {2'd0, \dut.valid [i]};
      wire [J-1:0] own = \dut.pendings [J*i-1 -: J];
      always @* begin
        if (started && \dut.valid [i] && following && ahead == at[i])
          assert ({\dut.errors [6*i-1 -: 6], \dut.residuals [R*i-1 -: R], own} == followed);
        if (started && \dut.valid [i] && !any && at[i] == 0) assert ((own & first) != 0);
      end
    end
  endgenerate

  always @* begin
    if (!started) assume (!rst_n);
    // Two references are only asked for with motion.
    if (pending.two) assume (pending.motion && !pending.key);
    if (!any && held == 0) assume (pending.job.first);
    if (started && offered) assume (in_valid && in_pending == offered_pending);
    if (started) begin
      assert (held == at[0]);
      if (waiting) assert (out_valid && {out_error, out_residual, out_pending} == waiting_block);
      if (following) assert (ahead < held);
      if (out_valid && following && ahead == 0)
        assert ({out_error, out_residual, out_pending} == {error, followed[J+R-1:0]});
      if (out_valid && !any) assert ((out_pending & first) != 0);
      assert (taken_b == {1'b0, \dut.kept_valid });
      if (\dut.kept_valid )
        assert (in_valid && pending.two && pending.first_from_b && \dut.kept_error == b_taken_error);
      if (out_valid || any) assert (\dut.chain_error == (out_valid ? out_error : before));
      if (rst_n && put) begin
        assert ((a_valid && a_ready) == needs_a);
        assert (taken_b + {1'b0, b_valid && b_ready} == needs_b);
      end
      if (rst_n && !put) begin
        assert (!(a_valid && a_ready));
        if (b_valid && b_ready) assert (in_valid && taken_b + 2'd1 < needs_b);
      end
    end
  end
endmodule
