// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Asks for the tiles of each block: its residual tile and, with motion tiles, its motion tile (IDX-2, MOT-1, MOT-2,
// MOT-4).
//
// Three stages for the tiles' numbers, then the stores. A block goes on when both stores have a place for its tile. Key
// images and blocks with an error need none. A request for the residuals of an image that has none, or is no reference
// image, gets bad_request here.
module hmlfc_tile_ask #(
    parameter int BLOCK_LOG2 = 2,
    parameter int RESIDUAL_CONTEXTS = 8,
    parameter int MOTION_CONTEXTS = 4,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input hmlfc_pkg::image_tiles_t image,  // of in_job.id

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

  localparam int STAGES = 3;
  localparam int CARRY_BITS = hmlfc_pkg::JOB_BITS + 1 + 1 + 1 + 1;

  // Stage i holds what it knows after i clocks: {job, needs_residual, needs_motion, predictive, keyed}.
  logic [STAGES:1] valid;
  logic [STAGES*CARRY_BITS-1:0] carries;
  logic advance;

  // Residual tile: plane, tile, and how many of its blocks are in the plane.
  wire chroma = in_job.plane != 2'd0;
  hmlfc_pkg::plane_t plane;
  assign plane = chroma ? stream.chroma : stream.luma;
  wire [21:0] plane_first = in_job.plane == 2'd2 ? stream.first_tile_cg : plane.first_tile;
  wire [10:0] tile_x = 11'(in_job.bx >> 3);
  wire [10:0] tile_y = 11'(in_job.by >> 3);
  logic [13:0] columns_1, rows_1;  // of the plane, from the tile on
  logic [7:0] size_2, size_3;  // {rows, columns} of the tile
  wire predictive = !stream.features.motion_tiles && !image.is_reference;

  logic [14:0] place_x, place_y;
  hmlfc_motion_place #(.BLOCK_LOG2(BLOCK_LOG2)) place (
      .stream, .plane(in_job.plane), .bx(in_job.bx), .by(in_job.by), .x(place_x), .y(place_y)
  );

  // 1: which tiles.
  logic [TILE_BITS-1:0] first_1;
  logic [21:0] plane_first_1;
  logic [10:0] tiles_x_1, tile_x_1, tile_y_1;
  logic second_1;
  logic [9:0] motion_x_1, motion_y_1;
  always_ff @(posedge clk) begin
    if (advance) begin
      {first_1, plane_first_1} <= {image.first_tile, plane_first};
      {tiles_x_1, tile_x_1, tile_y_1} <= {plane.tiles_x, tile_x, tile_y};
      columns_1 <= plane.blocks_x - {tile_x, 3'b000};
      rows_1 <= plane.blocks_y - {tile_y, 3'b000};
      second_1 <= chroma && stream.features.chroma_motion;
      motion_x_1 <= 10'(place_x >> stream.motion_tile_log2);
      motion_y_1 <= 10'(place_y >> stream.motion_tile_log2);
    end
  end

  // 2 and 3: their numbers and sizes.
  hmlfc_tile_number residual (
      .clk, .advance, .first_tile(first_1), .plane_first(plane_first_1), .tiles_x(tiles_x_1), .tile_x(tile_x_1),
      .tile_y(tile_y_1), .tile(residual_tile)
  );
  logic [15:0] motion_size;
  hmlfc_motion_tile motion (
      .clk, .advance, .stream, .second(second_1), .tile_x(motion_x_1), .tile_y(motion_y_1), .first_tile(first_1),
      .tile(motion_tile), .info(motion_size)
  );
  always_ff @(posedge clk) begin
    if (advance) begin
      size_2 <= {rows_1 > 14'd8 ? 4'd8 : rows_1[3:0], columns_1 > 14'd8 ? 4'd8 : columns_1[3:0]};
      size_3 <= size_2;
    end
  end

  // The stores.
  hmlfc_pkg::job_t job;
  logic needs_residual, needs_motion, predictive_3, keyed_3;
  assign {job, needs_residual, needs_motion, predictive_3, keyed_3} = carries[(STAGES-1)*CARRY_BITS+:CARRY_BITS];
  assign residual_info = {predictive_3, size_3};
  assign motion_info = {keyed_3, motion_size};
  hmlfc_pkg::job_t checked;
  always_comb begin
    checked = in_job;
    if (in_job.residuals && (image.keyed || !image.is_reference)) checked.error = HMLFC_ERROR_BAD_REQUEST;
  end
  wire coded = checked.error == 0 && !(image.keyed && image.is_reference);
  wire granted = (!needs_residual || residual_granted) && (!needs_motion || motion_granted);
  assign out_valid = valid[STAGES] && granted;
  assign advance = !valid[STAGES] || (granted && out_ready);
  assign in_ready = advance;
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
    if (advance) begin
      carries <= {
        carries[(STAGES-1)*CARRY_BITS-1:0],
        checked, coded, coded && stream.features.motion_tiles && !image.is_reference, predictive, image.keyed
      };
      valid <= {valid[STAGES-1:1], in_valid};
    end
    if (!rst_n) valid <= '0;
  end

endmodule

`default_nettype wire
