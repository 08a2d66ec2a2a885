// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Asks for the tile that holds a block's disparity, where its motion shares one (MOT-5, MOT-6).
//
// Four stages for the place of the grid block, then the store. In streams without shared disparities blocks pass by.
module hmlfc_disparity_ask #(
    parameter int BLOCK_LOG2 = 2,
    parameter int CONTEXTS = 4,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic [hmlfc_pkg::TILE_BITS-1:0] first_tile,  // of K0 of the image in_flow.job.id

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::flow_t in_flow,

    output logic ask,
    output logic [TILE_BITS-1:0] ask_tile,
    output logic [15:0] ask_info,
    input logic granted,
    input logic [$clog2(CONTEXTS)-1:0] granted_context,

    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow,
    output logic [4:0] out_x,
    output logic [4:0] out_y
);

  localparam int STAGES = 4;
  localparam int FLOW_BITS = hmlfc_pkg::FLOW_BITS;

  // Stage i holds what it knows after i clocks.
  logic [STAGES:1] valid, needed;
  logic [STAGES*FLOW_BITS-1:0] flows;
  wire pass = !stream.features.shared_disparity;
  wire done = valid[STAGES] && (!needed[STAGES] || granted);
  wire advance = !valid[STAGES] || (done && out_ready);
  hmlfc_disparity_place #(.BLOCK_LOG2(BLOCK_LOG2)) place (
      .clk, .advance, .stream, .flow(in_flow), .first_tile, .tile(ask_tile), .info(ask_info), .x(out_x), .y(out_y)
  );

  wire shares = in_flow.job.error == 0 && in_flow.motion.used && in_flow.motion.choice >= 4'd1 &&
      in_flow.motion.choice <= 4'd9;
  assign out_valid = pass ? in_valid : done;
  assign in_ready = pass ? out_ready : advance;
  assign ask = done && out_ready && needed[STAGES];
  always_comb begin
    out_flow = pass ? in_flow : flows[(STAGES-1)*FLOW_BITS+:FLOW_BITS];
    out_flow.disparity_asked = !pass && needed[STAGES];
    out_flow.disparity_context = 2'(granted_context);
  end

  always_ff @(posedge clk) begin
    if (advance) begin
      flows <= {flows[(STAGES-1)*FLOW_BITS-1:0], in_flow};
      needed <= {needed[STAGES-1:1], shares};
      valid <= {valid[STAGES-1:1], in_valid && !pass};
    end
    if (!rst_n) valid <= '0;
  end

endmodule

`default_nettype wire
