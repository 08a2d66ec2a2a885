// Asks for the tile that holds a block's disparity, where its motion shares one (MOT-5, MOT-6).
//
// Two stages: the place of the grid block, then the store.
module hmlfc_disparity_ask #(
    parameter int BLOCK_LOG2 = 2,
    parameter int CONTEXTS = 4,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input hmlfc_pkg::image_t image,  // of in_flow.job.id

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

  logic [TILE_BITS-1:0] tile;
  logic [15:0] info;
  logic [4:0] x, y;
  hmlfc_disparity_place #(
      .BLOCK_LOG2(BLOCK_LOG2)
  ) place (
      .stream,
      .flow(in_flow),
      .first_tile(image.disparity_tile),
      .tile,
      .info,
      .x,
      .y
  );

  logic valid, needed;
  hmlfc_pkg::flow_t flow;
  wire shares = in_flow.job.error == 0 && in_flow.motion.used && in_flow.motion.choice >= 4'd1 && in_flow.motion.choice <= 4'd9;
  assign out_valid = valid && (!needed || granted);
  assign in_ready = !valid || (out_valid && out_ready);
  assign ask = out_valid && out_ready && needed;
  always_comb begin
    out_flow = flow;
    out_flow.disparity_asked = needed;
    out_flow.disparity_context = 2'(granted_context);
  end

  always_ff @(posedge clk) begin
    if (in_ready) begin
      flow <= in_flow;
      needed <= shares;
      ask_tile <= tile;
      ask_info <= info;
      out_x <= x;
      out_y <= y;
    end
    if (!rst_n) valid <= 1'b0;
    else if (in_ready) valid <= in_valid;
  end

endmodule
