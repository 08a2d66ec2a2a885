// Works out the images of a view: its ancestors at all levels, their reference images, where their tiles and samples are
// (DEC-1, STR-1, STR-3, STR-4, EXT-3, EXT-4, MOT-7, IDX-1).
//
// `start` takes an existing view; for each level from 0 to tree_height `write` gives the entry of the table of images of level
// `write_level`, 25 clocks each, or 39 with balanced groups; `done` is high for one clock when all are written and `keys` holds:
// bit l: the image of level l is a key image (STR-5).
module hmlfc_view #(
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS,
    localparam int LEVELS = hmlfc_pkg::LEVELS,
    localparam int LEVEL_BITS = hmlfc_pkg::LEVEL_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic [LEVELS*LEVEL_BITS-1:0] levels,
    input logic start,
    input logic [9:0] view_row,
    input logic [9:0] view_col,
    output logic done,
    output logic [LEVELS-1:0] keys,

    output logic write,
    output logic [2:0] write_level,
    output hmlfc_pkg::image_t write_image
);

  typedef enum logic [3:0] {
    IDLE,
    AXES,
    NUMBER_0,
    NUMBER_1,
    NUMBER_2,
    NUMBER_3,
    IMAGES,
    TILES,
    WRITE
  } state_t;
  state_t state;

  logic [2:0] l;
  logic [9:0] row, col;
  hmlfc_pkg::level_t level;
  assign level = levels[32'(l)*LEVEL_BITS+:LEVEL_BITS];

  logic axes_start, rows_done, cols_done, rows_ready, cols_ready;
  logic [10:0] group_row, group_col, next_row_group, next_col_group;
  logic [9:0] own_row, own_col, next_row, next_col, parent_row, parent_col;
  hmlfc_group_axis rows (
      .clk,
      .rst_n,
      .start(axes_start),
      .at(row),
      .count(level.rows),
      .size(level.ref_rows),
      .groups(level.group_rows),
      .balanced(stream.features.balanced_groups),
      .cluster(stream.cluster_rows),
      .done(rows_done),
      .group(group_row),
      .reference_at(own_row),
      .next_group(next_row_group),
      .next_reference_at(next_row),
      .parent(parent_row)
  );
  hmlfc_group_axis cols (
      .clk,
      .rst_n,
      .start(axes_start),
      .at(col),
      .count(level.cols),
      .size(level.ref_cols),
      .groups(level.group_cols),
      .balanced(stream.features.balanced_groups),
      .cluster(stream.cluster_cols),
      .done(cols_done),
      .group(group_col),
      .reference_at(own_col),
      .next_group(next_col_group),
      .next_reference_at(next_col),
      .parent(parent_col)
  );

  // MOT-7: H is beside K0, V above or below it; the nearer direction's is K2.
  wire [9:0] distance_row = row > own_row ? row - own_row : own_row - row;
  wire [9:0] distance_col = col > own_col ? col - own_col : own_col - col;
  wire beside_first = distance_col >= distance_row;
  wire row_moves_1 = !beside_first;  // K1 is V
  wire row_moves_2 = beside_first;

  // Row and column of reference image k, and its address.
  logic [1:0] k;
  always_comb begin
    case (state)
      NUMBER_1: k = 2'd1;
      NUMBER_2: k = 2'd2;
      NUMBER_3: k = 2'd3;
      default: k = 2'd0;
    endcase
  end
  wire row_moves = k == 2'd3 || (k == 2'd1 && row_moves_1) || (k == 2'd2 && row_moves_2);
  wire col_moves = k == 2'd3 || (k == 2'd1 && !row_moves_1) || (k == 2'd2 && !row_moves_2);
  wire [10:0] k_row_group = row_moves ? next_row_group : group_row;
  wire [10:0] k_col_group = col_moves ? next_col_group : group_col;
  wire [21:0] reference_number = 22'(k_row_group) * 22'(level.group_cols) + 22'(k_col_group);
  wire [ADDRESS_BITS-1:0] reference_address = level.reference_address + ADDRESS_BITS'(reference_number) * ADDRESS_BITS'(stream.reference_bytes);
  wire signed [9:0] step_rows = $signed(row_moves ? next_row : own_row) - $signed(row);
  wire signed [9:0] step_cols = $signed(col_moves ? next_col : own_col) - $signed(col);
  wire signed [17:0] scaled_rows = step_rows * stream.row_scale;

  logic [21:0] image_number, reference_image;
  assign write = state == WRITE;
  assign write_level = l;

  always_ff @(posedge clk) begin
    done <= 1'b0;
    axes_start <= 1'b0;
    if (rows_done) rows_ready <= 1'b1;
    if (cols_done) cols_ready <= 1'b1;
    case (state)
      IDLE:
      if (start) begin
        l <= '0;
        row <= view_row;
        col <= view_col;
        keys <= '0;
        axes_start <= 1'b1;
        rows_ready <= 1'b0;
        cols_ready <= 1'b0;
        state <= AXES;
      end
      AXES: if (rows_ready && cols_ready) state <= NUMBER_0;
      NUMBER_0: begin
        write_image.address_0 <= reference_address;
        write_image.rows_0 <= scaled_rows;
        write_image.cols_0 <= step_cols;
        state <= NUMBER_1;
      end
      NUMBER_1: begin
        write_image.address_1 <= reference_address;
        write_image.rows_1 <= scaled_rows;
        write_image.cols_1 <= step_cols;
        state <= NUMBER_2;
      end
      NUMBER_2: begin
        write_image.address_2 <= reference_address;
        write_image.rows_2 <= scaled_rows;
        write_image.cols_2 <= step_cols;
        state <= NUMBER_3;
      end
      NUMBER_3: begin
        write_image.address_3 <= reference_address;
        write_image.rows_3 <= scaled_rows;
        write_image.cols_3 <= step_cols;
        state <= IMAGES;
      end
      IMAGES: begin
        image_number <= level.first_image + 22'(row) * 22'(level.cols) + 22'(col);
        reference_image <= level.first_image + 22'(own_row) * 22'(level.cols) + 22'(own_col);
        write_image.row <= row;
        write_image.col <= col;
        write_image.keyed <= level.keyed;
        write_image.is_reference <= row == own_row && col == own_col;
        state <= TILES;
      end
      TILES: begin
        write_image.first_tile <= TILE_BITS'(image_number) * TILE_BITS'(stream.tiles_per_image);
        write_image.disparity_tile <= TILE_BITS'(reference_image) * TILE_BITS'(stream.tiles_per_image);
        keys[l] <= write_image.keyed && write_image.is_reference;
        state <= WRITE;
      end
      WRITE: begin
        l <= l + 3'd1;
        row <= parent_row;
        col <= parent_col;
        rows_ready <= 1'b0;
        cols_ready <= 1'b0;
        axes_start <= l != stream.tree_height;
        done <= l == stream.tree_height;
        state <= l == stream.tree_height ? IDLE : AXES;
      end
      default: state <= IDLE;
    endcase
    if (!rst_n) begin
      state <= IDLE;
      done <= 1'b0;
      axes_start <= 1'b0;
    end
  end

endmodule
