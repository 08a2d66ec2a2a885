// A step from any state. A block enters with the references of its set (MOT-7), the vector's inputs (MOT-8; a key image's own samples, and blocks without
// motion, have vector 0), the addresses of its plane in them, and what is left of it. Seven stages later it asks, each once: cache A for the first window if
// this is K0's, else B; B for the second, after the first; and it leaves in order, with any stalls, when it has asked for all. Vectors may be anything.
// BLOCK_LOG2 = 2, residuals of 224 bits.
//
// Clauses: MOT-7
// Engine: bmc 2
// Complete: any step.
// Fault: hmlfc_reference_ask.sv / 3'd6: k_second = 2'd3 / 3'd6: k_second = 2'd2
// Fault: hmlfc_reference_ask.sv / (b_takes && first_from_b[STAGES]) / b_takes
// Fault: hmlfc_reference_ask.sv / x + 17'($signed(ix_b)) / x + 17'($signed(ix_a))
// Fault: hmlfc_reference_ask.sv / in_flow.job.plane == 2'd1 ? ADDRESS_BITS'(stream.luma_bytes) / in_flow.job.plane == 2'd2 ? ADDRESS_BITS'(stream.luma_bytes)
// Fault: hmlfc_reference_ask.sv / if (!rst_n || advance) begin / if (!rst_n) begin

// In the place of vector: what it is given, and any outputs.
module hmlfc_vector (
  input logic clk, input logic advance, input logic [12:0] disparity, input logic [9:0] coefficient_x, input logic [17:0] coefficient_y,
  input logic [1:0] vector_precision, input logic [2:0] disparity_precision, input logic [6:0] window, input logic explicit_mode,
  input logic [11:0] explicit_x, input logic [11:0] explicit_y, input logic halve, output logic [8:0] ix, output logic [8:0] iy, output logic [2:0] fx,
  output logic [2:0] fy);
  (* anyseq *) logic [23:0] any;
  assign {ix, iy, fx, fy} = any;
  wire [12:0] always_given = {advance, vector_precision, disparity_precision, window};
  wire [27:0] step = {coefficient_x, coefficient_y};
  wire [38:0] given = {disparity, explicit_mode, explicit_x, explicit_y, halve};
endmodule

module prove_reference_ask (
  input logic clk, input logic rst_n, input logic [hmlfc_pkg::IMAGE_REFERENCES_BITS-1:0] image_bits, input logic [hmlfc_pkg::FLOW_BITS-1:0] flow_bits,
  input logic in_valid, input logic in_has_residual, input logic [223:0] in_residual, input logic a_ready, input logic b_ready, input logic out_ready
);
  (* anyconst *) logic [750:0] stream_bits;
  hmlfc_pkg::config_t stream;
  hmlfc_pkg::image_references_t image;
  hmlfc_pkg::flow_t flow;
  assign stream = stream_bits;
  assign image = image_bits;
  assign flow = flow_bits;
  logic         in_ready, a_valid, b_valid, out_valid;
  logic [119:0] a_window, b_window;
  logic [hmlfc_pkg::PENDING_BITS-1:0] out_pending;
  logic [223:0] out_residual;
  hmlfc_reference_ask #(.BLOCK_LOG2(2), .RESIDUAL_BITS(224)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .image(image_bits), .in_flow(flow_bits), .in_valid(in_valid), .in_ready(in_ready),
    .in_has_residual(in_has_residual), .in_residual(in_residual), .a_valid(a_valid), .a_ready(a_ready), .a_window(a_window), .b_valid(b_valid),
    .b_ready(b_ready), .b_window(b_window), .out_valid(out_valid), .out_ready(out_ready), .out_pending(out_pending), .out_residual(out_residual));

  // The block that enters: {second, first}, numbers of its references, and what is known of each.
  logic [3:0]   numbers;
  logic         two;
  always @* begin
    case (flow.motion.reference_set)
      3'd0: {two, numbers} = {1'b0, 2'd0, 2'd0};
      3'd1: {two, numbers} = {1'b1, 2'd1, 2'd0};
      3'd2: {two, numbers} = {1'b1, 2'd2, 2'd0};
      3'd3: {two, numbers} = {1'b0, 2'd0, 2'd1};
      3'd4: {two, numbers} = {1'b0, 2'd0, 2'd2};
      3'd5: {two, numbers} = {1'b1, 2'd2, 2'd1};
      3'd6: {two, numbers} = {1'b1, 2'd3, 2'd0};
      3'd7: {two, numbers} = {1'b0, 2'd0, 2'd3};
    endcase
  end
  function automatic [39:0] address_of(input [1:0] k);
    address_of = k == 0 ? image_bits[271:232] : k == 1 ? image_bits[231:192] : k == 2 ? image_bits[191:152] : image_bits[151:112];
  endfunction
  function automatic [27:0] step_of(input [1:0] k);  // {cols, rows}
    step_of = k == 0 ? {image_bits[111:102], image_bits[71:54]} : k == 1 ? {image_bits[101:92], image_bits[53:36]} :
              k == 2 ? {image_bits[91:82], image_bits[35:18]} : {image_bits[81:72], image_bits[17:0]};
  endfunction
  wire        good = flow.job.error == 0;
  wire        key = image.keyed && image.is_reference && good;
  wire        motion = flow.motion.used && good && !key;
  wire [39:0] offset = flow.job.plane == 0 ? 40'd0 : 40'(stream.luma_bytes) + (flow.job.plane == 1 ? 40'd0 : 40'(stream.chroma_bytes));
  wire        halve = flow.job.plane != 0 && !stream.chroma_444 && stream.features.motion_tiles && !stream.features.chroma_motion;
  wire [12:0] disparity = flow.motion.choice == 10 ? {flow.motion.explicit_x[11], flow.motion.explicit_x} : flow.disparity;

  // Stages.
  localparam integer C = hmlfc_pkg::JOB_BITS + 6 + 224;
  (* hierconn *) wire [12:0]    \dut.vector_a.always_given , \dut.vector_b.always_given ;
  (* hierconn *) wire [27:0]    \dut.vector_a.step , \dut.vector_b.step ;
  (* hierconn *) wire [38:0]    \dut.vector_a.given , \dut.vector_b.given ;
  (* hierconn *) wire [23:0]    \dut.vector_a.any , \dut.vector_b.any ;  // {ix, iy, fx, fy}
  (* hierconn *) wire [7:1]     \dut.valid , \dut.first_from_b , \dut.section_a , \dut.section_b ;
  (* hierconn *) wire [7*C-1:0] \dut.carries ;
  (* hierconn *) wire [39:0]    \dut.base_a , \dut.base_b , \dut.offset_1 ;
  (* hierconn *) wire [479:0]   \dut.planes ;
  (* hierconn *) wire           \dut.first_taken , \dut.second_taken ;

  // The block at the last stage.
  hmlfc_pkg::job_t job;
  logic         is_key, is_zero, moved, negative, has_two, has_residual;
  logic [223:0] residual;
  assign {job, is_key, is_zero, moved, negative, has_two, has_residual, residual} = \dut.carries [7*C-1 -: C];
  wire        there = \dut.valid [7], from_b = \dut.first_from_b [7];
  wire [54:0] plane = job.plane == 0 ? {stream.luma.strips_x, stream.luma.width, stream.luma.height} :
                                       {stream.chroma.strips_x, stream.chroma.width, stream.chroma.height};
  function automatic [119:0] window_of(input section, input [39:0] address, input [23:0] vector);
    window_of = {section, address, job.plane, plane[40:0], 17'({job.bx, 2'd0}) + {{8{vector[23]}}, vector[23:15]},
                 17'({job.by, 2'd0}) + {{8{vector[14]}}, vector[14:6]}, vector[5:3] != 0, vector[2:0] != 0};
  endfunction
  wire        needs_first = is_key || moved;
  wire        first_left = there && needs_first && !\dut.first_taken ;
  wire        second_left = there && has_two && !\dut.second_taken ;
  wire        first_goes = first_left && (from_b ? b_ready : a_ready);
  wire        second_goes = second_left && b_ready && !(from_b && first_left);
  wire        whole = there && first_left == first_goes && second_left == second_goes;
  wire        moves = !there || (whole && out_ready);

  logic         was = 1'b0;
  logic         kept, first_taken, second_taken;
  logic [27:0]  step_a, step_b;
  logic [38:0]  given;
  logic [7:1]   valid, first_from_b, section_a, section_b;
  logic [7*C-1:0] carries;
  logic [119:0] bases;
  logic [479:0] planes;
  always @(posedge clk) begin
    was <= 1'b1;
    kept <= rst_n && !moves;
    {first_taken, second_taken} <= {\dut.first_taken || first_goes, \dut.second_taken || second_goes};
    valid <= !rst_n ? 7'd0 : moves ? {\dut.valid [6:1], in_valid} : \dut.valid ;
    if (moves) begin
      {step_a, step_b} <= {step_of(numbers[1:0]), step_of(numbers[3:2])};
      given <= {disparity, flow.motion.choice == 11 || !motion, motion ? {flow.motion.explicit_x, flow.motion.explicit_y} : 24'd0, halve};
      first_from_b <= {\dut.first_from_b [6:1], motion && numbers[1:0] != 0};
      section_a <= {\dut.section_a [6:1], numbers[1]};
      section_b <= {\dut.section_b [6:1], numbers[3]};
      carries <= {\dut.carries [6*C-1:0], flow.job, key, motion && image.keyed, motion, motion && flow.motion.negative, motion && two, in_has_residual,
                  in_residual};
      bases <= {address_of(motion ? numbers[1:0] : 2'd0), address_of(numbers[3:2]), offset};
      planes <= {\dut.planes [399:0], \dut.base_a + \dut.offset_1 , \dut.base_b + \dut.offset_1 };
    end else begin
      {step_a, step_b, given} <= {\dut.vector_a.step , \dut.vector_b.step , \dut.vector_a.given };
      {first_from_b, section_a, section_b} <= {\dut.first_from_b , \dut.section_a , \dut.section_b };
      {carries, bases, planes} <= {\dut.carries , \dut.base_a , \dut.base_b , \dut.offset_1 , \dut.planes };
    end
  end
  always @* begin
    if (!was) begin
      assert (in_ready == moves && out_valid == whole && a_valid == (first_left && !from_b) && b_valid == ((first_left && from_b) || second_left));
      if (a_valid) assert (a_window == window_of(\dut.section_a [7], \dut.planes [479:440], \dut.vector_a.any ));
      if (b_valid)
        assert (b_window == (first_left && from_b ? window_of(\dut.section_a [7], \dut.planes [479:440], \dut.vector_a.any ) :
                                                    window_of(\dut.section_b [7], \dut.planes [439:400], \dut.vector_b.any )));
      if (out_valid)
        assert ({out_pending, out_residual} == {job, is_key, is_zero, moved, negative, has_two, from_b, has_residual, \dut.vector_a.any , \dut.vector_b.any ,
                                                residual});
      assert (\dut.vector_a.always_given == {moves, stream.vector_precision, stream.disparity_precision, stream.window});
      assert (\dut.vector_b.always_given == \dut.vector_a.always_given && \dut.vector_b.given == \dut.vector_a.given );
    end else begin
      assert (\dut.valid == valid && {\dut.vector_a.step , \dut.vector_b.step , \dut.vector_a.given } == {step_a, step_b, given});
      assert ({\dut.first_from_b , \dut.section_a , \dut.section_b } == {first_from_b, section_a, section_b});
      assert (\dut.carries == carries && {\dut.base_a , \dut.base_b , \dut.offset_1 } == bases && \dut.planes == planes);
      // Whether a window that the block does not need counts as asked for does not matter.
      if (!kept) assert (!\dut.first_taken && !\dut.second_taken );
      if (kept && needs_first) assert (\dut.first_taken == first_taken);
      if (kept && has_two) assert (\dut.second_taken == second_taken);
    end
  end
endmodule
