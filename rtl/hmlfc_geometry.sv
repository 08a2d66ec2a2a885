`include "hmlfc_tables.svh"

// Derives the geometry of the stream from its header: planes, tiles, levels, addresses.
//
// `start` when the header's fields are valid; `done` is high for one clock when `error`, `stream` and `levels` are valid, which then hold.
// Errors: limit_exceeded (FIL-7) for streams beyond this unit's limits, then bad_section_size (IDX-4, IDX-5).
// Level l is at levels[l * $bits(level_t) +: ...].
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

  // Planes (STR-2, STR-6, MOT-1).
  wire [14:0] chroma_width = chroma_444 ? width[14:0] : 15'((width + 17'd1) >> 1);
  wire [14:0] chroma_height = chroma_444 ? height[14:0] : 15'((height + 17'd1) >> 1);
  hmlfc_pkg::plane_t luma, chroma;
  logic [21:0] luma_tiles, chroma_tiles, motion_luma_tiles, motion_chroma_tiles;
  logic [31:0] luma_strips, chroma_strips;
  hmlfc_pkg::motion_plane_t motion_luma, motion_chroma;
  hmlfc_plane_size #(
      .BLOCK_LOG2(BLOCK_LOG2)
  ) luma_size (
      .width(width[14:0]),
      .height(height[14:0]),
      .motion_tile_log2,
      .plane(luma),
      .tiles(luma_tiles),
      .strips(luma_strips),
      .motion_plane(motion_luma),
      .motion_tiles(motion_luma_tiles)
  );
  hmlfc_plane_size #(
      .BLOCK_LOG2(BLOCK_LOG2)
  ) chroma_size (
      .width(chroma_width),
      .height(chroma_height),
      .motion_tile_log2,
      .plane(chroma),
      .tiles(chroma_tiles),
      .strips(chroma_strips),
      .motion_plane(motion_chroma),
      .motion_tiles(motion_chroma_tiles)
  );
  wire motion_tiles = features[HMLFC_FEATURE_MOTION_TILES];
  wire chroma_motion = features[HMLFC_FEATURE_CHROMA_MOTION];

  wire beyond = block_log2 != 2'(BLOCK_LOG2) || depth > 4'(MAX_DEPTH) || width > 17'(MAX_SIDE) || height > 17'(MAX_SIDE) ||
      rows > 13'(MAX_GRID) || cols > 13'(MAX_GRID) || tree_height > 4'(LEVELS - 1);

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
    stream.chroma.first_tile = luma_tiles;
    stream.first_tile_cg = luma_tiles + chroma_tiles;
    stream.motion_luma = motion_luma;
    stream.motion_luma.first_tile = luma_tiles + (chroma_tiles << 1);
    stream.motion_chroma = motion_chroma;
    stream.motion_chroma.first_tile = stream.motion_luma.first_tile + motion_luma_tiles;
    stream.tiles_per_image = luma_tiles + (chroma_tiles << 1);
    if (motion_tiles) stream.tiles_per_image = stream.motion_chroma.first_tile;
    if (motion_tiles && chroma_motion) stream.tiles_per_image = stream.motion_chroma.first_tile + motion_chroma_tiles;
    stream.root_address = stream_base + root_offset[ADDRESS_BITS-1:0];
    stream.group_address = stream_base + group_offset[ADDRESS_BITS-1:0];
    stream.group_records = group_size[ADDRESS_BITS-1:4];
    stream.tile_address = stream_base + tile_offset[ADDRESS_BITS-1:0];
    stream.tile_bytes = tile_size[ADDRESS_BITS-1:0];
    stream.luma_bytes = 34'(luma_strips) * 34'(hmlfc_pkg::STRIP_BYTES);
    stream.chroma_bytes = 34'(chroma_strips) * 34'(hmlfc_pkg::STRIP_BYTES);
    stream.reference_bytes = stream.luma_bytes + (stream.chroma_bytes << 1);
  end

  // Levels: their sizes from the views up, then places in the stream and in the reference area from the top down.
  typedef enum logic [3:0] {
    IDLE,
    GROUP_ROWS,
    GROUP_COLS,
    PARENT_ROWS,
    PARENT_COLS,
    PLACE,
    TILES,
    SIZES,
    FINISH
  } state_t;
  state_t state;
  logic [2:0] l;
  logic [10:0] level_rows, level_cols, group_rows, group_cols;
  logic [21:0] images;
  logic [ADDRESS_BITS-1:0] reference_address;
  wire [3:0] number = tree_height - 4'(l);  // of the level's entry, from the top
  wire [23:0] entry = level_entries[32'(number)*24+:24];

  logic [10:0] dividend, quotient;
  logic [7:0] divisor;
  always_comb begin
    case (state)
      GROUP_ROWS: {dividend, divisor} = {level_rows, entry[7:0]};
      GROUP_COLS: {dividend, divisor} = {level_cols, entry[15:8]};
      PARENT_ROWS: {dividend, divisor} = {level_rows, cluster_rows};
      default: {dividend, divisor} = {level_cols, cluster_cols};
    endcase
  end
  logic started, divider_idle, divided;
  wire divides = state == GROUP_ROWS || state == GROUP_COLS || state == PARENT_ROWS || state == PARENT_COLS;
  hmlfc_divide #(
      .WIDTH(11)
  ) divide (
      .clk,
      .rst_n,
      .start(divides && !started && divider_idle),
      .dividend(dividend - 11'd1),
      .divisor(11'(divisor)),
      .idle(divider_idle),
      .done(divided),
      .quotient
  );
  wire [10:0] ceiling = quotient + 11'd1;  // of the division, whose dividend is at least 1

  hmlfc_pkg::level_t placed;
  always_comb begin
    placed = levels[32'(l)*LEVEL_BITS+:LEVEL_BITS];
    placed.first_image = images;
    placed.reference_address = reference_address;
  end

  logic [43:0] tiles;
  wire [43:0] root_bytes = ((tiles + 44'd4095) >> 12) << 4;

  always_ff @(posedge clk) begin
    done <= 1'b0;
    if (divides && divider_idle) started <= 1'b1;
    if (divided) started <= 1'b0;
    case (state)
      IDLE:
      if (start) begin
        error <= beyond ? HMLFC_ERROR_LIMIT_EXCEEDED : 6'd0;
        l <= '0;
        level_rows <= rows[10:0];
        level_cols <= cols[10:0];
        state <= beyond ? FINISH : GROUP_ROWS;
      end
      GROUP_ROWS:
      if (divided) begin
        group_rows <= ceiling;
        state <= GROUP_COLS;
      end
      GROUP_COLS:
      if (divided) begin
        group_cols <= ceiling;
        state <= PARENT_ROWS;
      end
      PARENT_ROWS: begin
        levels[32'(l)*LEVEL_BITS+:LEVEL_BITS] <= {
          level_rows, level_cols, entry[7:0], entry[15:8], group_rows, group_cols,
          l == tree_height[2:0] || entry[16], {(LEVEL_BITS-61){1'b0}}
        };
        if (divided) begin
          level_rows <= ceiling;
          state <= PARENT_COLS;
        end
      end
      PARENT_COLS:
      if (divided) begin
        level_cols <= ceiling;
        l <= l + 3'd1;
        state <= GROUP_ROWS;
        if (l == tree_height[2:0]) begin
          l <= l;
          images <= '0;
          reference_address <= reference_base;
          state <= PLACE;
        end
      end
      PLACE: begin
        levels[32'(l)*LEVEL_BITS+:LEVEL_BITS] <= placed;
        images <= images + 22'(placed.rows) * 22'(placed.cols);
        reference_address <= reference_address +
            ADDRESS_BITS'(22'(placed.group_rows) * 22'(placed.group_cols)) * ADDRESS_BITS'(stream.reference_bytes);
        l <= l - 3'd1;
        if (l == 0) state <= TILES;
      end
      TILES: begin
        tiles <= 44'(images) * 44'(stream.tiles_per_image);
        state <= SIZES;
      end
      SIZES: begin
        if (root_size != 64'(root_bytes) || group_size[3:0] != 0) error <= HMLFC_ERROR_BAD_SECTION_SIZE;
        state <= FINISH;
      end
      default: begin  // FINISH
        done <= 1'b1;
        state <= IDLE;
      end
    endcase
    if (!rst_n) begin
      state <= IDLE;
      started <= 1'b0;
      done <= 1'b0;
    end
  end

endmodule
