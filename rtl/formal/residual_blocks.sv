// A block enters when its tile is loaded or it needs none, and moves on by a stage in each clock in which the last is empty or leaves; all others change
// nothing. Its flow stays as it came but for the first error of tile, vector and entry where it has none yet (MOT-10), and its vector. Words are read,
// and the tile given back, with the entry at hand. BLOCK_LOG2 = 2, MAX_DEPTH = 12, 2 contexts.
//
// Clauses: MOT-10, TIL-7
// Engine: bmc 2
// Cut: ram bise_unpack
// Complete: one step of twelve stages with anything in them.
// Fault: hmlfc_residual_blocks.sv / flow_1.residual_asked && flow_1.job.error == 0 / flow_1.residual_asked
// Fault: hmlfc_residual_blocks.sv / $signed(vector_3[15:8]) / $signed(vector_3[7:0])
// Fault: hmlfc_residual_blocks.sv / valid[3] && flow_3.residual_asked / flow_3.residual_asked
`include "hmlfc_tables.svh"
module prove_residual_blocks (
  input logic clk, input logic [1:0] ready, input logic head_write, input logic vector_write, input logic entry_write, input logic parsed_context,
  input logic [5:0] head_error, input logic [63:0] head_motion, input logic [63:0] head_residual, input logic [5:0] vector_number,
  input logic [17:0] vector_data, input logic [5:0] entry_number, input logic [47:0] entry_data, input logic [511:0] window, input logic in_valid,
  input logic [hmlfc_pkg::FLOW_BITS-1:0] in_flow, input logic out_ready
);
  localparam integer F = hmlfc_pkg::FLOW_BITS;
  (* anyconst *) logic [750:0] stream_bits;
  logic         release_valid, release_context, read_enable, in_ready, out_valid, out_has_residual;
  logic [9:0]   read_word;
  logic [F-1:0] out_flow;
  logic [223:0] out_residual;
  hmlfc_residual_blocks #(.BLOCK_LOG2(2), .MAX_DEPTH(12), .CONTEXTS(2), .CONTEXT_WORDS(512), .WINDOW_BITS(512)) dut (
    .clk(clk), .rst_n(1'b1), .stream(stream_bits), .ready(ready), .release_valid(release_valid), .release_context(release_context),
    .head_write(head_write), .vector_write(vector_write), .entry_write(entry_write), .parsed_context(parsed_context), .head_error(head_error),
    .head_motion(head_motion), .head_residual(head_residual), .vector_number(vector_number), .vector_data(vector_data),
    .entry_number(entry_number), .entry_data(entry_data), .read_enable(read_enable), .read_word(read_word), .window(window), .in_valid(in_valid),
    .in_ready(in_ready), .in_flow(in_flow), .out_valid(out_valid), .out_ready(out_ready), .out_flow(out_flow), .out_has_residual(out_has_residual),
    .out_residual(out_residual));

  (* hierconn *) wire [12:1] \dut.valid ;
  (* hierconn *) wire [12*F-1:0] \dut.flows ;
  (* hierconn *) wire [12:2] \dut.has_residual ;
  (* hierconn *) wire \dut.has_motion_3 ;
  (* hierconn *) wire [133:0] \dut.heads.read_data ;
  (* hierconn *) wire [17:0] \dut.vectors.read_data ;
  (* hierconn *) wire [47:0] \dut.entries.read_data ;
  (* hierconn *) wire [223:0] \dut.scale.residuals ;
  hmlfc_pkg::flow_t enters, at_3, leaves_1, leaves_3;
  assign enters = in_flow;
  assign at_3 = \dut.flows [2*F +: F];
  wire advance = !\dut.valid [12] || out_ready;
  wire [5:0] entry_error = \dut.entries.read_data [47:42];
  always @* begin
    leaves_1 = \dut.flows [0 +: F];
    if (leaves_1.job.error == 0 && leaves_1.residual_asked) leaves_1.job.error = \dut.heads.read_data [133:128];
    leaves_3 = \dut.flows [2*F +: F];
    if (leaves_3.job.error == 0) leaves_3.job.error = \dut.has_motion_3 && \dut.vectors.read_data [17] ? HMLFC_ERROR_VECTOR_RANGE :
        \dut.has_residual [3] ? entry_error : 6'd0;
    if (\dut.has_motion_3 ) begin
      leaves_3.motion.used = 1'b1;
      leaves_3.motion.negative = \dut.vectors.read_data [16];
      leaves_3.motion.choice = 4'd11;
      leaves_3.motion.explicit_x = {{4{\dut.vectors.read_data [7]}}, \dut.vectors.read_data [7:0]};
      leaves_3.motion.explicit_y = {{4{\dut.vectors.read_data [15]}}, \dut.vectors.read_data [15:8]};
    end
  end

  // What each stage holds after this clock.
  logic           stepped = 1'b0;
  logic [12:1]    valid;
  logic [12*F-1:0] flows;
  logic [12:3]    has_residual;
  always @(posedge clk) begin
    stepped <= 1'b1;
    valid <= advance ? {\dut.valid [11:1], in_valid && in_ready} : \dut.valid ;
    flows <= advance ? {\dut.flows [3*F +: 8*F], leaves_3, \dut.flows [F +: F], leaves_1, in_flow} : \dut.flows ;
    has_residual <= advance ? \dut.has_residual [11:2] : \dut.has_residual [12:3];
  end
  always @* begin
    assert (in_ready == (advance && (!enters.residual_asked || ready[enters.residual_context[0]])));
    assert (release_valid == (advance && \dut.valid [3] && at_3.residual_asked) && release_context == at_3.residual_context[0]);
    assert (read_enable == advance && read_word == {at_3.residual_context[0], \dut.entries.read_data [14:6]});
    assert (out_valid == \dut.valid [12] && out_flow == \dut.flows [11*F +: F] && out_has_residual == \dut.has_residual [12]);
    assert (out_residual == (out_has_residual ? \dut.scale.residuals : 224'd0));
    if (stepped) assert (\dut.valid == valid && \dut.flows == flows && \dut.has_residual [12:3] == has_residual);
  end
endmodule
