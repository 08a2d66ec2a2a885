// Each block that enters leaves once and in order with its own job, whatever is asked of the output and whenever its windows come: the
// blocks inside are those of the list of what entered; a block that leaves does not change while it waits; each block takes the windows
// it asked for, each once, those of B in the order first, second; and no window passes without a block. BLOCK_LOG2 = 1, MAX_DEPTH = 8.
//
// Clauses: DEC-3 for its order, MOT-10
// Engine: induction 2 6
// Complete: the list is bound to the stages' registers, so the induction needs no reachability.
// Fault: hmlfc_compose.sv / assign in_ready = first_there && second_there && advance / assign in_ready = first_there && advance
// Fault: hmlfc_compose.sv / if (!rst_n || go) kept_valid <= 1'b0 / if (!rst_n) kept_valid <= 1'b0
module prove_compose #(
  parameter integer BLOCK_LOG2 = 1,
  parameter integer MAX_DEPTH = 8
) (
  input logic clk, input logic rst_n, input logic in_valid, input logic [hmlfc_pkg::PENDING_BITS-1:0] in_pending, input logic a_valid, input logic b_valid,
  input logic out_ready
);
  hmlfc_pkg::pending_t pending;
  assign pending = in_pending;
  logic        in_ready, a_ready, b_ready, out_valid;
  logic [hmlfc_pkg::PENDING_BITS-1:0] out_pending;
  hmlfc_compose #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH)) dut (
    .clk(clk), .rst_n(rst_n), .depth(4'd8), .in_valid(in_valid), .in_ready(in_ready), .in_pending(pending), .in_residual('0),
    .a_valid(a_valid), .a_ready(a_ready), .a_error(6'd0), .a_window('0), .b_valid(b_valid), .b_ready(b_ready), .b_error(6'd0),
    .b_window('0), .out_valid(out_valid), .out_ready(out_ready), .out_pending(out_pending), .out_error(), .out_sample(),
    .out_residual(), .out_reference(), .out_prediction());
  (* hierconn *) wire [7:1] \dut.valid ;
  (* hierconn *) wire [7*hmlfc_pkg::PENDING_BITS-1:0] \dut.pendings ;
  (* hierconn *) wire \dut.kept_valid ;

  // Only what entered is followed: a tag, the block's job.
  logic           started = 1'b0;
  logic [2:0]     held;
  logic [7*hmlfc_pkg::PENDING_BITS-1:0] list;
  wire            put = in_valid && in_ready;
  wire            take = out_valid && out_ready;
  wire [2:0]      rest = held - {2'd0, take};
  wire [7*hmlfc_pkg::PENDING_BITS-1:0] list_left = take ? list >> hmlfc_pkg::PENDING_BITS : list;
  always @(posedge clk) begin
    started <= 1'b1;
    held <= rst_n ? rest + {2'd0, put} : 3'd0;
    list <= list_left;
    for (integer i = 0; i < 7; i = i + 1) if (put && rest == i) list[hmlfc_pkg::PENDING_BITS*i +: hmlfc_pkg::PENDING_BITS] <= in_pending;
  end

  // Windows that the block in front needs and has not taken: of A; of B.
  wire needs_first = pending.key || pending.motion;
  wire needs_a = needs_first && !pending.first_from_b;
  wire [1:0] needs_b = {1'b0, pending.two} + {1'b0, needs_first && pending.first_from_b};
  logic [1:0] taken_b;
  always @(posedge clk) begin
    if (!rst_n || put) taken_b <= 2'd0;
    else taken_b <= taken_b + {1'b0, b_valid && b_ready};
  end

  logic        waiting, offered;
  logic [hmlfc_pkg::PENDING_BITS-1:0] waiting_pending, offered_pending;
  always @(posedge clk) begin
    waiting <= rst_n && out_valid && !out_ready;
    waiting_pending <= out_pending;
    offered <= rst_n && in_valid && !in_ready;
    offered_pending <= in_pending;
  end

  // Stages from the oldest on: how many blocks are in front of stage i.
  wire [2:0] at_6 = {2'd0, out_valid};
  wire [2:0] at_5 = at_6 + {2'd0, \dut.valid [6]};
  wire [2:0] at_4 = at_5 + {2'd0, \dut.valid [5]};
  wire [2:0] at_3 = at_4 + {2'd0, \dut.valid [4]};
  wire [2:0] at_2 = at_3 + {2'd0, \dut.valid [3]};
  wire [2:0] at_1 = at_2 + {2'd0, \dut.valid [2]};
  function automatic [hmlfc_pkg::PENDING_BITS-1:0] entry(input [7*hmlfc_pkg::PENDING_BITS-1:0] from, input [2:0] at);
    entry = 0;
    for (integer i = 0; i < 7; i = i + 1) if (at == i) entry = from[hmlfc_pkg::PENDING_BITS*i +: hmlfc_pkg::PENDING_BITS];
  endfunction

  always @* begin
    if (!started) assume (!rst_n);
    // Two references are only asked for with motion.
    if (pending.two) assume (pending.motion && !pending.key);
    if (started && offered) assume (in_valid && in_pending == offered_pending);
    if (started) begin
      assert (held == at_1 + {2'd0, \dut.valid [1]});
      if (out_valid) assert (out_pending == list[hmlfc_pkg::PENDING_BITS-1:0]);
      if (\dut.valid [6]) assert (\dut.pendings [hmlfc_pkg::PENDING_BITS*5 +: hmlfc_pkg::PENDING_BITS] == entry(list, at_6));
      if (\dut.valid [5]) assert (\dut.pendings [hmlfc_pkg::PENDING_BITS*4 +: hmlfc_pkg::PENDING_BITS] == entry(list, at_5));
      if (\dut.valid [4]) assert (\dut.pendings [hmlfc_pkg::PENDING_BITS*3 +: hmlfc_pkg::PENDING_BITS] == entry(list, at_4));
      if (\dut.valid [3]) assert (\dut.pendings [hmlfc_pkg::PENDING_BITS*2 +: hmlfc_pkg::PENDING_BITS] == entry(list, at_3));
      if (\dut.valid [2]) assert (\dut.pendings [hmlfc_pkg::PENDING_BITS*1 +: hmlfc_pkg::PENDING_BITS] == entry(list, at_2));
      if (\dut.valid [1]) assert (\dut.pendings [hmlfc_pkg::PENDING_BITS*0 +: hmlfc_pkg::PENDING_BITS] == entry(list, at_1));
      assert (taken_b == {1'b0, \dut.kept_valid });
      if (\dut.kept_valid ) assert (in_valid && pending.two && pending.first_from_b);
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
  always @(posedge clk) begin
    if (started && $past(started) && waiting) assert (out_valid && out_pending == waiting_pending);
  end
endmodule
