// Asks for the tiles of each block: its residual tile and, with motion tiles, its motion tile (IDX-2, MOT-1, MOT-2, MOT-4).
//
// Two stages: tile numbers, then the stores. A block goes on when both stores have a place for its tile. Key images and blocks
// with an error need none.
module hmlfc_tile_ask #(
    parameter int BLOCK_LOG2 = 2,
    parameter int RESIDUAL_CONTEXTS = 8,
    parameter int MOTION_CONTEXTS = 4,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input hmlfc_pkg::image_t image,  // of in_job.id

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::job_t in_job,

    output logic residual_ask,
    output logic [TILE_BITS-1:0] residual_tile,
    output logic [8:0] residual_info,
    input logic residual_granted,
    input logic [$clog2(RESIDUAL_CONTEXTS)-1:0] residual_context,

    output logic motion_ask,
    output logic [TILE_BITS-1:0] motion_tile,
    output logic [16:0] motion_info,
    input logic motion_granted,
    input logic [$clog2(MOTION_CONTEXTS)-1:0] motion_context,

    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::flow_t out_flow
);

  // Residual tile: plane, tile, and how many of its blocks are in the plane.
  wire chroma = in_job.plane != 2'd0;
  hmlfc_pkg::plane_t plane;
  assign plane = chroma ? stream.chroma : stream.luma;
  wire [21:0] plane_first = in_job.plane == 2'd2 ? stream.first_tile_cg : plane.first_tile;
  wire [10:0] tile_x = 11'(in_job.bx >> 3);
  wire [10:0] tile_y = 11'(in_job.by >> 3);
  wire [13:0] columns_left = plane.blocks_x - {tile_x, 3'b000};
  wire [13:0] rows_left = plane.blocks_y - {tile_y, 3'b000};
  wire [3:0] columns = columns_left > 14'd8 ? 4'd8 : columns_left[3:0];
  wire [3:0] rows = rows_left > 14'd8 ? 4'd8 : rows_left[3:0];
  wire predictive = !stream.features.motion_tiles && !image.is_reference;

  logic [14:0] place_x, place_y;
  hmlfc_motion_place #(
      .BLOCK_LOG2(BLOCK_LOG2)
  ) place (
      .stream,
      .plane(in_job.plane),
      .bx(in_job.bx),
      .by(in_job.by),
      .x(place_x),
      .y(place_y)
  );
  logic [TILE_BITS-1:0] motion_number;
  logic [15:0] motion_size;
  hmlfc_motion_tile motion (
      .stream,
      .second(chroma && stream.features.chroma_motion),
      .tile_x(10'(place_x >> stream.motion_tile_log2)),
      .tile_y(10'(place_y >> stream.motion_tile_log2)),
      .first_tile(image.first_tile),
      .tile(motion_number),
      .info(motion_size)
  );

  logic valid, needs_residual, needs_motion;
  hmlfc_pkg::job_t job;
  wire coded = in_job.error == 0 && !(image.keyed && image.is_reference);
  wire granted = (!needs_residual || residual_granted) && (!needs_motion || motion_granted);
  assign out_valid = valid && granted;
  assign in_ready = !valid || (granted && out_ready);
  assign residual_ask = out_valid && out_ready && needs_residual;
  assign motion_ask = out_valid && out_ready && needs_motion;

  always_comb begin
    out_flow = '0;
    out_flow.job = job;
    out_flow.residual_asked = needs_residual;
    out_flow.residual_context = 5'(residual_context);
    out_flow.motion_asked = needs_motion;
    out_flow.motion_context = 2'(motion_context);
  end

  always_ff @(posedge clk) begin
    if (in_ready) begin
      job <= in_job;
      needs_residual <= coded;
      needs_motion <= coded && stream.features.motion_tiles && !image.is_reference;
      residual_tile <= image.first_tile + TILE_BITS'(plane_first) + TILE_BITS'(22'(tile_y) * 22'(plane.tiles_x)) + TILE_BITS'(tile_x);
      residual_info <= {predictive, rows, columns};
      motion_tile <= motion_number;
      motion_info <= {image.keyed, motion_size};
    end
    if (!rst_n) valid <= 1'b0;
    else if (in_ready) valid <= in_valid;
  end

endmodule
