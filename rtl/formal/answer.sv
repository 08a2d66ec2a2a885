// Each block that ends a request gives exactly one answer, in order, with its own status and tlast: blocks that end requests are taken
// and answers given in equal numbers but for those inside; an answer does not change while it waits. For a request of one plane the
// answer is the block's samples, or, for residuals, its residuals, 0 where it has none. For RGB the colour transform gets the samples of Y and, by COL-3, those of Co and Cg at its pixels, each
// of the latest last block of its plane, and the answer is what the transform gives for them two clocks later (proof colour); its status
// is the first error of Y, Co and Cg. With an error the samples are 0. BLOCK_LOG2 = 1, MAX_DEPTH = 8; any stalls.
//
// Clauses: Answers (docs/decode_unit.md), COL-2 for its place in the order, COL-3
// Engine: induction 2 6
// Complete: the list of blocks inside is bound to the stages' registers, so the induction needs no reachability.
// Fault: hmlfc_answer.sv / !valid[3] || advance_out / !valid[3] && advance_out
// Fault: hmlfc_answer.sv / last <= {last[2:1], in_job.tlast} / last <= {last[2:1], last[1]}
// Fault: hmlfc_answer.sv / rgb_error = y_error != 0 ? y_error : / rgb_error =
// Fault: hmlfc_answer.sv / cg_1 <= at_pixels(cg, / cg_1 <= at_pixels(held_co,
// Fault: hmlfc_answer.sv / {in_job.by[0], in_job.bx[0]} : corner / {in_job.bx[0], in_job.by[0]} : corner
// Fault: hmlfc_answer.sv / full ? py * B + px / 1'b1 ? py * B + px
// Fault: hmlfc_answer.sv / if (rgb[3]) answer = lanes_3 / if (rgb[2]) answer = lanes_3
// Fault: hmlfc_answer.sv / in_has_residual ? in_residual / 1'b1 ? in_residual
module prove_answer (
  input logic clk, input logic rst_n, input logic in_valid, input logic [hmlfc_pkg::JOB_BITS-1:0] in_job, input logic [5:0] in_error,
  input logic [35:0] in_sample, input logic in_has_residual, input logic [39:0] in_residual, input logic out_ready, input logic [3:0] depth, input logic chroma_444
);
  hmlfc_pkg::job_t job;
  assign job = in_job;
  logic         in_ready, out_valid, out_last;
  logic [191:0] out_data;
  logic [5:0]   out_error;
  hmlfc_answer #(.BLOCK_LOG2(1), .MAX_DEPTH(8)) dut (
    .clk(clk), .rst_n(rst_n), .depth(depth), .chroma_444(chroma_444), .in_valid(in_valid), .in_ready(in_ready), .in_job(job),
    .in_error(in_error), .in_sample(in_sample), .in_has_residual(in_has_residual), .in_residual(in_residual), .chroma_spoiled(), .out_valid(out_valid), .out_ready(out_ready), .out_data(out_data),
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
  (* hierconn *) wire [35:0] \dut.co_1 ;
  (* hierconn *) wire [35:0] \dut.cg_1 ;
  (* hierconn *) wire [35:0] \dut.y_2 ;
  (* hierconn *) wire [35:0] \dut.y_3 ;
  (* hierconn *) wire [3:0] \dut.signs_1 ;
  (* hierconn *) wire [3:0] \dut.signs_2 ;
  (* hierconn *) wire [3:0] \dut.signs_3 ;
  (* hierconn *) wire [191:0] \dut.lanes_3 ;
  (* hierconn *) wire [198:0] \dut.out.skid ;

  // The latest last blocks of requests for RGB: {error, samples}, and the place of that of Y.
  wire         kept = in_valid && in_ready && job.rgb && job.last;
  wire  [41:0] block = {in_error, in_sample};
  logic [41:0] y_kept, co_kept, cg_kept;
  logic [1:0]  place_kept;
  always @(posedge clk) begin
    if (kept && job.plane == 0) {y_kept, place_kept} <= {block, job.by[0], job.bx[0]};
    if (kept && job.plane == 1) co_kept <= block;
    if (kept && job.plane == 2) cg_kept <= block;
  end
  (* hierconn *) wire [35:0] \dut.held_y ;
  (* hierconn *) wire [35:0] \dut.held_co ;
  (* hierconn *) wire [35:0] \dut.held_cg ;
  (* hierconn *) wire [5:0] \dut.error_y ;
  (* hierconn *) wire [5:0] \dut.error_co ;
  (* hierconn *) wire [5:0] \dut.error_cg ;
  (* hierconn *) wire [1:0] \dut.corner ;

  // Chroma at the four pixels: that of pixel (x, y) of a block at (bx, by) is sample ((2 bx + x) / 2, (2 by + y) / 2) of the plane, in a
  // block of 2 x 2.
  function automatic [35:0] pixels(input [35:0] plane, input [1:0] place, input full);
    for (integer k = 0; k < 4; k = k + 1)
      pixels[9*k +: 9] = full ? plane[9*k +: 9] : plane >> (9 * (2 * ((2 * place[1] + k / 2) / 2) + (2 * place[0] + k % 2) / 2));
  endfunction

  // The values of a request for one plane: {bits 9, bits 8 to 0}.
  wire [39:0] values;
  generate
    for (genvar i = 0; i < 4; i = i + 1) begin : g_value
      wire [9:0] value = !job.residuals ? {in_sample[9*i+8], in_sample[9*i +: 9]} : in_has_residual ? in_residual[10*i +: 10] : 10'd0;
      assign {values[36+i], values[9*i +: 9]} = value;
    end
  endgenerate

  // The blocks inside that end a request: {signs, cg, co, rgb, tlast, error, samples}, the oldest at the bottom.
  localparam integer E = 120;
  logic           started = 1'b0;
  logic [2:0]     held;
  logic [5*E-1:0] list;
  wire            put = in_valid && in_ready && job.answer;
  wire            take = out_valid && out_ready;
  wire [2:0]      rest = held - {2'd0, take};
  wire [5*E-1:0]  list_left = take ? list >> E : list;
  wire [41:0]     y = job.plane == 0 ? block : y_kept;
  wire [41:0]     cg = job.plane == 2 ? block : cg_kept;
  wire [1:0]      place = job.plane == 0 ? {job.by[0], job.bx[0]} : place_kept;
  wire [5:0]      first_error = y[41:36] != 0 ? y[41:36] : co_kept[41:36] != 0 ? co_kept[41:36] : cg[41:36];
  wire [E-1:0]    entry = {values[39:36], pixels(cg[35:0], place, chroma_444), pixels(co_kept[35:0], place, chroma_444), job.rgb, job.tlast,
                           job.rgb ? {first_error, y[35:0]} : {in_error, values[35:0]}};
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

  // What the transform gave for the answers that wait in the slice; the older at the bottom.
  logic [383:0] given;
  wire          leaves = \dut.valid [3] && \dut.advance_out ;
  wire [383:0]  given_left = take ? given >> 192 : given;
  wire          one_stays = \dut.advance_out ? out_valid && !take : 1'b1;
  always @(posedge clk) given <= !leaves ? given_left : one_stays ? {\dut.lanes_3 , given_left[191:0]} : {given_left[383:192], \dut.lanes_3 };

  // An answer that fits the entry, with the transform's result for it.
  function automatic fits(input [E-1:0] e, input [191:0] transformed, input last, input [5:0] error, input [191:0] data);
    reg [191:0] lanes;
    lanes = e[43] ? transformed : 192'd0;
    if (!e[43]) for (integer i = 0; i < 4; i = i + 1) lanes[16*i +: 16] = {{7{e[116+i]}}, e[9*i +: 9]};
    if (e[41:36] != 0) lanes = 192'd0;
    fits = last == e[42] && error == e[41:36] && data == lanes;
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
      if (!\dut.advance_out ) assert (out_valid);
      if (out_valid) assert (fits(list[0 +: E], given[191:0], out_last, out_error, out_data));
      if (!\dut.advance_out )
        assert (fits(e_skid, given[383:192], \dut.out.skid [198], \dut.out.skid [197:192], \dut.out.skid [191:0]));
      if (\dut.valid [3]) assert ({\dut.rgb [3], \dut.last [3], \dut.status_3 } == e_3[43:36] && (e_3[43] || {\dut.signs_3 , \dut.y_3 } == {e_3[119:116], e_3[35:0]}));
      if (\dut.valid [2]) assert ({\dut.rgb [2], \dut.last [2], \dut.status_2 } == e_2[43:36] && (e_2[43] || {\dut.signs_2 , \dut.y_2 } == {e_2[119:116], e_2[35:0]}));
      if (\dut.valid [1]) begin
        assert ({\dut.rgb [1], \dut.last [1], \dut.status_1 , \dut.y_1 } == e_1[43:0]);
        if (e_1[43]) assert ({\dut.cg_1 , \dut.co_1 } == e_1[115:44]);
        else assert (\dut.signs_1 == e_1[119:116]);
      end
    end
  end
  always @(posedge clk) begin
    if (started && $past(started) && waiting) assert (out_valid && {out_last, out_error, out_data} == waiting_answer);
  end
endmodule
