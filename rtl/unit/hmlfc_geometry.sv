// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Derives the geometry of the stream from its header: planes, tiles, levels, addresses.
//
// `start` when the header's fields are valid; `done` is high for one clock when `error`, `stream` and `levels` are
// valid, which then hold. Errors, in the order of FIL-8: limit_exceeded (FIL-7) for streams beyond this unit's limits,
// then bad_section_size (IDX-4, IDX-5). Level l is at levels[l * $bits(level_t) +: ...], its entry in the header at
// level_entries[24 * l +: 24]. Only LOAD waits for it: products and quotients come one after the other from one
// multiplier and one divider, fewer than 1300 clocks for a tree of 8 levels.
module hmlfc_geometry #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int LEVELS = hmlfc_pkg::LEVELS,
    localparam int LEVEL_BITS = hmlfc_pkg::LEVEL_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    output logic done,
    output logic [5:0] error,

    input logic [ADDRESS_BITS-1:0] stream_base,
    input logic [ADDRESS_BITS-1:0] reference_base,

    input logic [8:0] features,
    input logic [12:0] rows,
    input logic [12:0] cols,
    input logic [16:0] width,
    input logic [16:0] height,
    input logic [3:0] depth,
    input logic chroma_444,
    input logic [1:0] block_log2,
    input logic [6:0] window,
    input logic [7:0] cluster_rows,
    input logic [7:0] cluster_cols,
    input logic [3:0] tree_height,
    input logic [1:0] vector_precision,
    input logic [2:0] disparity_precision,
    input logic [2:0] motion_tile_log2,
    input logic [2:0] disparity_grid_log2,
    input logic [7:0] row_scale,
    input logic [16*24-1:0] level_entries,
    input logic [63:0] root_offset,
    input logic [63:0] root_size,
    input logic [63:0] group_offset,
    input logic [63:0] group_size,
    input logic [63:0] tile_offset,
    input logic [63:0] tile_size,

    output hmlfc_pkg::config_t stream,
    output logic [LEVELS*LEVEL_BITS-1:0] levels
);

  localparam int MAX_SIDE = 16384;
  localparam int MAX_GRID = 1024;
  localparam int PLACE_BITS = 22 + ADDRESS_BITS;  // of level_t: first_image, reference_address

  wire motion_tiles = features[HMLFC_FEATURE_MOTION_TILES];
  wire chroma_motion = features[HMLFC_FEATURE_CHROMA_MOTION];
  wire beyond = block_log2 != 2'(BLOCK_LOG2) || depth > 4'(MAX_DEPTH) || width > 17'(MAX_SIDE) ||
      height > 17'(MAX_SIDE) ||
      rows > 13'(MAX_GRID) || cols > 13'(MAX_GRID) || tree_height > 4'(LEVELS - 1);

  // Planes; then levels, their sizes from the views up, and their places in the stream and in the reference area from
  // the top down.
  typedef enum logic [4:0] {
    IDLE,
    TILES_Y,
    TILES_CO,
    TILES_CG,
    MOTION_LUMA,
    MOTION_CHROMA,
    STRIPS_Y,
    BYTES_Y,
    STRIPS_C,
    BYTES_C,
    REFERENCE,
    GROUP_ROWS,
    GROUP_COLS,
    PARENT_ROWS,
    PARENT_COLS,
    IMAGES,
    GROUPS,
    AREA,
    TILES,
    SIZES,
    FINISH
  } state_t;
  state_t state;
  logic [2:0] l;
  logic [10:0] level_rows, level_cols, group_rows, group_cols;
  logic [21:0] next_tile, tiles_per_image, first_tile_co, first_tile_cg, first_tile_luma, first_tile_chroma, images;
  logic [33:0] luma_bytes, chroma_bytes, reference_bytes;
  logic [ADDRESS_BITS-1:0] reference_address, root_address, group_address, tile_address;

  // The sizes of the plane that the state is about (STR-2, STR-6, MOT-1), two clocks later.
  wire of_chroma = state == TILES_CO || state == TILES_CG || state == MOTION_CHROMA || state == STRIPS_C;
  logic [14:0] plane_width, plane_height;
  hmlfc_pkg::plane_t plane, luma, chroma;
  hmlfc_pkg::motion_plane_t motion_plane, motion_luma, motion_chroma;
  logic [10:0] tiles_y;
  logic [9:0] motion_tiles_y;
  always_ff @(posedge clk) begin
    plane_width <= of_chroma && !chroma_444 ? 15'((width + 17'd1) >> 1) : width[14:0];
    plane_height <= of_chroma && !chroma_444 ? 15'((height + 17'd1) >> 1) : height[14:0];
  end
  hmlfc_plane_size #(.BLOCK_LOG2(BLOCK_LOG2)) plane_size (
      .clk, .width(plane_width), .height(plane_height), .motion_tile_log2, .plane, .tiles_y, .motion_plane,
      .motion_tiles_y
  );

  // Level l, one clock later: what its entry and its own sizes are.
  logic [23:0] entry;
  hmlfc_pkg::level_t placed;
  always_ff @(posedge clk) begin
    for (int i = 0; i < LEVELS; i++) begin
      if (l == 3'(i)) begin
        entry <= level_entries[24*i+:24];
        placed <= levels[i*LEVEL_BITS+:LEVEL_BITS];
      end
    end
  end

  // The state after each that has but one.
  state_t following;
  always_comb begin
    unique case (state)
      TILES_Y: following = TILES_CO;
      TILES_CO: following = TILES_CG;
      TILES_CG: following = MOTION_LUMA;
      MOTION_LUMA: following = MOTION_CHROMA;
      MOTION_CHROMA: following = STRIPS_Y;
      STRIPS_Y: following = BYTES_Y;
      BYTES_Y: following = STRIPS_C;
      STRIPS_C: following = BYTES_C;
      BYTES_C: following = REFERENCE;
      REFERENCE: following = GROUP_ROWS;
      GROUP_ROWS: following = GROUP_COLS;
      GROUP_COLS: following = PARENT_ROWS;
      PARENT_ROWS: following = PARENT_COLS;
      IMAGES: following = GROUPS;
      GROUPS: following = AREA;
      TILES: following = SIZES;
      default: following = IDLE;
    endcase
  end

  // A state's operands are valid three clocks after it began; its result ends it.
  logic [1:0] age;
  logic started, divider_idle, divided, multiplier_idle, multiplied;
  wire divides = state == GROUP_ROWS || state == GROUP_COLS || state == PARENT_ROWS || state == PARENT_COLS;
  wire multiplies = state != IDLE && !divides && state != SIZES && state != FINISH;
  wire operands = age == 2'd3 && !started;
  wire finished = divided || multiplied;

  logic [10:0] dividend, quotient;
  logic [7:0] divisor;
  always_comb begin
    unique case (state)
      GROUP_ROWS: {dividend, divisor} = {level_rows, entry[7:0]};
      GROUP_COLS: {dividend, divisor} = {level_cols, entry[15:8]};
      PARENT_ROWS: {dividend, divisor} = {level_rows, cluster_rows};
      default: {dividend, divisor} = {level_cols, cluster_cols};
    endcase
  end
  hmlfc_divide #(.WIDTH(11)) divide (
      .clk, .rst_n, .start(divides && operands && divider_idle), .dividend(dividend - 11'd1), .divisor(11'(divisor)),
      .idle(divider_idle), .done(divided), .quotient
  );
  wire [10:0] ceiling = quotient + 11'd1;  // of the division, whose dividend is at least 1

  logic [33:0] a;
  logic [21:0] b;
  logic [43:0] c, sum;
  always_comb begin
    a = 34'(plane.tiles_x);
    b = 22'(tiles_y);
    c = 44'(next_tile);
    unique case (state)
      MOTION_LUMA, MOTION_CHROMA: begin
        a = 34'(motion_plane.tiles_x);
        b = 22'(motion_tiles_y);
      end
      STRIPS_Y, STRIPS_C: begin
        a = 34'(plane.strips_x);
        b = 22'(plane.blocks_y);
        c = '0;
      end
      BYTES_Y, BYTES_C: begin
        a = sum[33:0];
        b = 22'(hmlfc_pkg::STRIP_BYTES);
        c = '0;
      end
      REFERENCE: begin
        a = chroma_bytes;
        b = 22'd2;
        c = 44'(luma_bytes);
      end
      IMAGES: begin
        a = 34'(placed.rows);
        b = 22'(placed.cols);
        c = 44'(images);
      end
      GROUPS: begin
        a = 34'(placed.group_rows);
        b = 22'(placed.group_cols);
        c = '0;
      end
      AREA: begin
        a = reference_bytes;
        b = sum[21:0];
        c = 44'(reference_address);
      end
      TILES: begin
        a = 34'(tiles_per_image);
        b = images;
        c = 44'd4095;
      end
      default: ;
    endcase
  end
  hmlfc_multiply_add #(.A_BITS(34), .B_BITS(22), .SUM_BITS(44)) multiply_add (
      .clk, .rst_n, .start(multiplies && operands && multiplier_idle), .a, .b, .c, .idle(multiplier_idle),
      .done(multiplied), .sum
  );

  wire [35:0] root_bytes = {sum[43:12], 4'd0};  // 16 for each 4096 tiles or part of them

  always_ff @(posedge clk) begin
    done <= 1'b0;
    age <= age + 2'(age != 2'd3);
    if ((divides || multiplies) && operands) started <= 1'b1;
    if (finished) begin
      started <= 1'b0;
      age <= '0;
    end
    unique case (state)
      IDLE: begin
        age <= '0;
        started <= 1'b0;
        l <= '0;
        next_tile <= '0;
        level_rows <= rows[10:0];
        level_cols <= cols[10:0];
        images <= '0;
        reference_address <= reference_base;
        root_address <= stream_base + root_offset[ADDRESS_BITS-1:0];
        group_address <= stream_base + group_offset[ADDRESS_BITS-1:0];
        tile_address <= stream_base + tile_offset[ADDRESS_BITS-1:0];
        if (start) begin
          error <= beyond ? HMLFC_ERROR_LIMIT_EXCEEDED : 6'd0;
          state <= beyond ? FINISH : TILES_Y;
        end
      end
      PARENT_COLS:
      if (finished) begin
        level_cols <= ceiling;
        if (l == tree_height[2:0]) state <= IMAGES;
        else begin
          l <= l + 3'd1;
          state <= GROUP_ROWS;
        end
      end
      AREA:
      if (finished) begin
        reference_address <= sum[ADDRESS_BITS-1:0];
        l <= l - 3'd1;
        state <= l == 0 ? TILES : IMAGES;
      end
      SIZES: begin
        if (root_size != 64'(root_bytes) || group_size[3:0] != 0) error <= HMLFC_ERROR_BAD_SECTION_SIZE;
        state <= FINISH;
      end
      FINISH: begin
        done <= 1'b1;
        state <= IDLE;
      end
      default: if (finished) state <= following;
    endcase
    if (finished) begin
      unique case (state)
        TILES_Y: begin
          luma <= plane;
          first_tile_co <= sum[21:0];
        end
        TILES_CO: begin
          chroma <= plane;
          first_tile_cg <= sum[21:0];
        end
        TILES_CG: begin
          first_tile_luma <= sum[21:0];
          tiles_per_image <= sum[21:0];
        end
        MOTION_LUMA: begin
          motion_luma <= motion_plane;
          first_tile_chroma <= sum[21:0];
          if (motion_tiles) tiles_per_image <= sum[21:0];
        end
        MOTION_CHROMA: begin
          motion_chroma <= motion_plane;
          if (motion_tiles && chroma_motion) tiles_per_image <= sum[21:0];
        end
        BYTES_Y: luma_bytes <= sum[33:0];
        BYTES_C: chroma_bytes <= sum[33:0];
        REFERENCE: reference_bytes <= sum[33:0];
        GROUP_ROWS: group_rows <= ceiling;
        GROUP_COLS: group_cols <= ceiling;
        PARENT_ROWS: level_rows <= ceiling;
        IMAGES: images <= sum[21:0];
        default: ;
      endcase
      if (state == TILES_Y || state == TILES_CO || state == TILES_CG || state == MOTION_LUMA) next_tile <= sum[21:0];
      for (int i = 0; i < LEVELS; i++) begin
        if (l == 3'(i) && state == PARENT_ROWS) begin
          levels[i*LEVEL_BITS+PLACE_BITS+:LEVEL_BITS-PLACE_BITS] <= {
            level_rows, level_cols, entry[7:0], entry[15:8], group_rows, group_cols, l == tree_height[2:0] || entry[16]
          };
        end
        if (l == 3'(i) && state == IMAGES) levels[i*LEVEL_BITS+:PLACE_BITS] <= {images, reference_address};
      end
    end
    if (!rst_n) begin
      state <= IDLE;
      done <= 1'b0;
    end
  end

  always_comb begin
    stream = '0;
    stream.features = features;
    stream.depth = depth;
    stream.chroma_444 = chroma_444;
    stream.tree_height = tree_height[2:0];
    stream.window = window;
    stream.vector_precision = vector_precision;
    stream.disparity_precision = disparity_precision;
    stream.motion_tile_log2 = motion_tile_log2;
    stream.disparity_grid_log2 = disparity_grid_log2;
    stream.row_scale = row_scale;
    stream.rows = rows[10:0];
    stream.cols = cols[10:0];
    stream.cluster_rows = cluster_rows;
    stream.cluster_cols = cluster_cols;
    stream.luma = luma;
    stream.chroma = chroma;
    stream.chroma.first_tile = first_tile_co;
    stream.first_tile_cg = first_tile_cg;
    stream.motion_luma = motion_luma;
    stream.motion_luma.first_tile = first_tile_luma;
    stream.motion_chroma = motion_chroma;
    stream.motion_chroma.first_tile = first_tile_chroma;
    stream.tiles_per_image = tiles_per_image;
    stream.root_address = root_address;
    stream.group_address = group_address;
    stream.group_records = group_size[ADDRESS_BITS-1:4];
    stream.tile_address = tile_address;
    stream.tile_bytes = tile_size[ADDRESS_BITS-1:0];
    stream.luma_bytes = luma_bytes;
    stream.chroma_bytes = chroma_bytes;
    stream.reference_bytes = reference_bytes;
  end

endmodule

`default_nettype wire
