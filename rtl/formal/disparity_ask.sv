// Each block leaves once, in order, with any stalls: at once in a stream without shared disparities, else four clocks
// later, when the store has a place for the tile of its disparity, where its motion shares one (MOT-5). It asks for it
// then, for the tile of hmlfc_disparity_place. BLOCK_LOG2 = 2, CONTEXTS = 4. The first 7 clocks.
//
// Clauses: MOT-5, MOT-6
// Engine: bmc 7
// Complete: four stages without feedback.
module prove_disparity_ask #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer CONTEXTS = 4
) (
  input logic clk, input logic [hmlfc_pkg::TILE_BITS-1:0] first_tile, input logic in_valid,
      input logic [hmlfc_pkg::FLOW_BITS-1:0] in_flow,
  input logic granted, input logic [$clog2(CONTEXTS)-1:0] granted_context, input logic out_ready
);
  localparam integer F = hmlfc_pkg::FLOW_BITS;
  (* anyconst *) hmlfc_pkg::config_t stream;
  hmlfc_pkg::flow_t flow;
  hmlfc_pkg::flow_t given;
  hmlfc_pkg::flow_t expected;
  assign given = in_flow;
  logic         started = 1'b0;
  logic         in_ready, ask, out_valid;
  logic [hmlfc_pkg::TILE_BITS-1:0] ask_tile, tile;
  logic [15:0]  ask_info, info;
  logic [4:0]   out_x, out_y, x, y;
  logic [F-1:0] out_flow;
  assign flow = out_flow;
  hmlfc_disparity_ask #(.BLOCK_LOG2(BLOCK_LOG2), .CONTEXTS(CONTEXTS)) dut (
    .clk(clk), .rst_n(started), .stream(stream), .first_tile(first_tile), .in_valid(in_valid), .in_ready(in_ready),
    .in_flow(in_flow), .ask(ask), .ask_tile(ask_tile), .ask_info(ask_info), .granted(granted),
    .granted_context(granted_context), .out_valid(out_valid), .out_ready(out_ready), .out_flow(out_flow), .out_x(out_x),
    .out_y(out_y));
  (* hierconn *) wire \dut.advance ;
  hmlfc_disparity_place #(.BLOCK_LOG2(BLOCK_LOG2)) place (
    .clk(clk), .advance(\dut.advance ), .stream(stream), .flow(in_flow), .first_tile(first_tile), .tile(tile),
    .info(info), .x(x), .y(y));

  wire shares = given.job.error == 0 && given.motion.used && given.motion.choice >= 1 && given.motion.choice <= 9;
  wire shared = stream.features.shared_disparity;
  logic [4:1]     valid, needs;
  logic [4*F-1:0] flows;
  always @(posedge clk) begin
    started <= 1'b1;
    if (in_ready) {needs, flows} <= {needs[3:1], shares, flows[3*F-1:0], in_flow};
    valid <= !started || !shared ? 4'd0 : in_ready ? {valid[3:1], in_valid} : valid;
  end
  (* hierconn *) wire [4:1] \dut.valid ;
  (* hierconn *) wire [4:1] \dut.needed ;
  always @* begin
    expected = flows[3*F +: F];
    expected.disparity_asked = needs[4];
    expected.disparity_context = granted_context;
    if (started && shared) begin
      assert (\dut.valid == valid && (\dut.needed & valid) == (needs & valid));
      assert (out_valid == (valid[4] && (!needs[4] || granted)) &&
          in_ready == (!valid[4] || (out_valid && out_ready)) && in_ready == \dut.advance );
      assert (ask == (out_valid && out_ready && needs[4]));
      if (out_valid) assert (flow == expected);
      if (out_valid && needs[4]) assert (ask_tile == tile && ask_info == info && out_x == x && out_y == y);
    end
    if (started && !shared) begin
      assert (out_valid == in_valid && in_ready == out_ready && !ask);
      if (out_valid)
        assert (flow.job == given.job && flow.motion == given.motion && !flow.disparity_asked &&
            flow.residual_asked == given.residual_asked);
      if (out_valid)
        assert (flow.residual_context == given.residual_context && flow.motion_asked == given.motion_asked);
      if (out_valid) assert (flow.motion_context == given.motion_context && flow.disparity == given.disparity);
    end
  end
endmodule
