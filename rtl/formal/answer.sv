// Each block that ends a request gives exactly one answer, in order, with its own status and tlast: blocks that end requests are taken
// and answers given in equal numbers but for those inside; an answer does not change while it waits. For a request of one plane the
// answer is the block's samples, or 0 with an error. BLOCK_LOG2 = 1, MAX_DEPTH = 8.
//
// Clauses: Answers (docs/hardware.md), COL-2 for its place in the order
// Engine: induction 2 6
// Complete: the list of blocks inside is bound to the stages' registers, so the induction needs no reachability.
// Fault: hmlfc_answer.sv / !valid[3] || advance_out / !valid[3] && advance_out
// Fault: hmlfc_answer.sv / last <= {last[2:1], in_job.tlast} / last <= {last[2:1], last[1]}
module prove_answer (
  input logic clk, input logic rst_n, input logic in_valid, input logic [hmlfc_pkg::JOB_BITS-1:0] in_job, input logic [5:0] in_error,
  input logic [35:0] in_sample, input logic out_ready, input logic [3:0] depth, input logic chroma_444
);
  hmlfc_pkg::job_t job;
  assign job = in_job;
  logic         in_ready, out_valid, out_last;
  logic [191:0] out_data;
  logic [5:0]   out_error;
  hmlfc_answer #(.BLOCK_LOG2(1), .MAX_DEPTH(8)) dut (
    .clk(clk), .rst_n(rst_n), .depth(depth), .chroma_444(chroma_444), .in_valid(in_valid), .in_ready(in_ready), .in_job(job),
    .in_error(in_error), .in_sample(in_sample), .chroma_spoiled(), .out_valid(out_valid), .out_ready(out_ready), .out_data(out_data),
    .out_error(out_error), .out_last(out_last));
  (* hierconn *) wire [3:1] \dut.valid ;
  (* hierconn *) wire [3:1] \dut.last ;
  (* hierconn *) wire \dut.advance ;
  (* hierconn *) wire \dut.advance_out ;
  (* hierconn *) wire [3:1] \dut.rgb ;
  (* hierconn *) wire [5:0] \dut.status_1 ;
  (* hierconn *) wire [5:0] \dut.status_2 ;
  (* hierconn *) wire [5:0] \dut.status_3 ;
  (* hierconn *) wire [35:0] \dut.y_1 ;
  (* hierconn *) wire [35:0] \dut.y_2 ;
  (* hierconn *) wire [35:0] \dut.y_3 ;
  (* hierconn *) wire [198:0] \dut.out.skid ;

  // The blocks inside that end a request of one plane or of RGB: {rgb, tlast, error, samples}, the oldest at the bottom.
  localparam integer E = 44;
  logic           started = 1'b0;
  logic [2:0]     held;
  logic [5*E-1:0] list;
  wire            put = in_valid && in_ready && job.answer;
  wire            take = out_valid && out_ready;
  wire [2:0]      rest = held - {2'd0, take};
  wire [5*E-1:0]  list_left = take ? list >> E : list;
  wire [E-1:0]    entry = {job.rgb, job.tlast, in_error, in_sample};
  always @(posedge clk) begin
    started <= 1'b1;
    held <= rst_n ? rest + {2'd0, put} : 3'd0;
    list <= list_left;
    if (put && rest == 0) list[0*E +: E] <= entry;
    if (put && rest == 1) list[1*E +: E] <= entry;
    if (put && rest == 2) list[2*E +: E] <= entry;
    if (put && rest == 3) list[3*E +: E] <= entry;
    if (put && rest == 4) list[4*E +: E] <= entry;
  end

  // An answer that fits the entry.
  function automatic fits(input [E-1:0] e, input last, input [5:0] error, input [191:0] data);
    reg [191:0] lanes;
    lanes = 192'd0;
    if (e[41:36] == 0) for (integer i = 0; i < 4; i = i + 1) lanes[16*i +: 16] = {{7{e[9*i+8]}}, e[9*i +: 9]};
    fits = last == e[42] && (e[43] || (error == e[41:36] && data == lanes));
  endfunction

  // The stages from the oldest on: the slice's two registers, stages 3 to 1.
  wire [2:0] at_skid = {2'd0, out_valid};
  wire [2:0] at_3 = at_skid + {2'd0, !\dut.advance_out };
  wire [2:0] at_2 = at_3 + {2'd0, \dut.valid [3]};
  wire [2:0] at_1 = at_2 + {2'd0, \dut.valid [2]};
  wire [E-1:0] e_skid = list >> (E * at_skid);
  wire [E-1:0] e_3 = list >> (E * at_3);
  wire [E-1:0] e_2 = list >> (E * at_2);
  wire [E-1:0] e_1 = list >> (E * at_1);

  logic         waiting;
  logic [198:0] waiting_answer;
  always @(posedge clk) begin
    waiting <= rst_n && out_valid && !out_ready;
    waiting_answer <= {out_last, out_error, out_data};
  end

  always @* begin
    if (!started) assume (!rst_n);
    else begin
      assert (held == at_1 + {2'd0, \dut.valid [1]});
      assert (held <= 5);
      if (!\dut.advance_out ) assert (out_valid);
      if (out_valid) assert (fits(list[0 +: E], out_last, out_error, out_data));
      if (!\dut.advance_out ) assert (fits(e_skid, \dut.out.skid [198], \dut.out.skid [197:192], \dut.out.skid [191:0]));
      if (\dut.valid [3]) begin
        assert (\dut.last [3] == e_3[42] && \dut.rgb [3] == e_3[43]);
        if (!e_3[43]) assert (\dut.status_3 == e_3[41:36] && \dut.y_3 == e_3[35:0]);
      end
      if (\dut.valid [2]) begin
        assert (\dut.last [2] == e_2[42] && \dut.rgb [2] == e_2[43]);
        if (!e_2[43]) assert (\dut.status_2 == e_2[41:36] && \dut.y_2 == e_2[35:0]);
      end
      if (\dut.valid [1]) begin
        assert (\dut.last [1] == e_1[42] && \dut.rgb [1] == e_1[43]);
        if (!e_1[43]) assert (\dut.status_1 == e_1[41:36] && \dut.y_1 == e_1[35:0]);
      end
    end
  end
  always @(posedge clk) begin
    if (started && $past(started) && waiting) assert (out_valid && {out_last, out_error, out_data} == waiting_answer);
  end
endmodule
