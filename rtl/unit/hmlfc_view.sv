// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Works out the images of a view: its ancestors at all levels, their reference images, where their tiles and samples
// are (DEC-1, STR-1, STR-3, STR-4, EXT-3, EXT-4, MOT-7, IDX-1).
//
// `start` takes an existing view; for each level from 0 to tree_height `write` gives the entry of the table of images
// of level `write_level`: 19 clocks each, or 26 with balanced groups, and 4 more for the last; with one
// unit for both axes 12 or 19 more for each level. `done` is high for one clock when all are written and `keys` holds:
// bit l: the image of level l is a key image (STR-5).
//
// Six addresses of a level go through one pipeline, one a clock: of the four reference images, of the image's first
// tile, of that of K0. Each is the number of an image, row * columns + column, times what an image takes, on top of the
// first.
module hmlfc_view #(
    parameter int UNITS = 2,  // units for rows and columns: 1, 2
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

  typedef enum logic [1:0] {
    IDLE,
    AXES,
    ADDRESSES
  } state_t;
  state_t state;

  // Level l, one clock later.
  logic [2:0] l;
  logic [9:0] row, col;
  hmlfc_pkg::level_t level;
  always_ff @(posedge clk) level <= levels[32'(l)*LEVEL_BITS+:LEVEL_BITS];

  // Rows and columns beside each other, or with one unit columns after rows, whose results are kept.
  localparam int AXIS_BITS = 11 + 10 + 11 + 10 + 10;
  logic axes_start, axes_done, of_cols;
  logic [UNITS-1:0] axis_done;
  logic [UNITS*AXIS_BITS-1:0] axis;
  logic [AXIS_BITS-1:0] of_rows;
  logic [10:0] group_row, group_col, next_row_group, next_col_group;
  logic [9:0] own_row, own_col, next_row, next_col, parent_row, parent_col;
  for (genvar g = 0; g < UNITS; g++) begin : g_axis
    wire cols = UNITS == 2 ? g == 1 : of_cols;
    hmlfc_group_axis one_axis (
        .clk, .rst_n, .start(axes_start || (UNITS == 1 && axis_done[g] && !of_cols)), .at(cols ? col : row),
        .count(cols ? level.cols : level.rows), .size(cols ? level.ref_cols : level.ref_rows),
        .groups(cols ? level.group_cols : level.group_rows), .balanced(stream.features.balanced_groups),
        .cluster(cols ? stream.cluster_cols : stream.cluster_rows), .done(axis_done[g]),
        .group(axis[g*AXIS_BITS+41+:11]), .reference_at(axis[g*AXIS_BITS+31+:10]),
        .next_group(axis[g*AXIS_BITS+20+:11]), .next_reference_at(axis[g*AXIS_BITS+10+:10]),
        .parent(axis[g*AXIS_BITS+:10])
    );
  end
  assign axes_done = &axis_done && (UNITS == 2 || of_cols);
  if (UNITS == 2) begin : g_together
    assign {of_cols, of_rows} = {1'b0, axis[AXIS_BITS-1:0]};
  end else begin : g_in_turn
    always_ff @(posedge clk) begin
      if (axis_done[0] && !of_cols) of_rows <= axis;
      of_cols <= !axes_start && (of_cols || axis_done[0]);
    end
  end
  assign {group_row, own_row, next_row_group, next_row, parent_row} = of_rows;
  assign {group_col, own_col, next_col_group, next_col, parent_col} = axis[UNITS*AXIS_BITS-1-:AXIS_BITS];

  // MOT-7: H is beside K0, V above or below it; the nearer direction's is K2.
  wire [9:0] distance_row = row > own_row ? row - own_row : own_row - row;
  wire [9:0] distance_col = col > own_col ? col - own_col : own_col - col;
  wire is_reference = row == own_row && col == own_col;
  wire beside_first = distance_col >= distance_row;

  // Address k: reference images K0 to K3, the image's first tile, that of K0's disparities.
  logic [2:0] k;
  wire row_moves = k == 3'd3 || (k == 3'd1 && !beside_first) || (k == 3'd2 && beside_first);
  wire col_moves = k == 3'd3 || (k == 3'd1 && beside_first) || (k == 3'd2 && !beside_first);
  wire of_tiles = k[2];
  wire reads = state == ADDRESSES;
  wire last_k = k == 3'd5;
  wire last_level = l == stream.tree_height;

  // 1: what is numbered, and how far it is from the image.
  logic valid_1, valid_2, valid_3;
  logic [2:0] k_1, k_2, k_3;
  logic [10:0] row_1, col_1, columns_1;
  logic [21:0] first_1;
  logic [33:0] unit_1, unit_2;
  logic [ADDRESS_BITS-1:0] base_1, base_2, base_3;
  logic signed [9:0] step_rows_1, step_cols_1, step_cols_2, step_cols_3;
  // 2: its number. 3: the product, by halves of both. 4: the sum, in write_image.
  logic [21:0] number_2;
  logic signed [17:0] step_rows_2, step_rows_3;
  // half of the number, half of what an image takes
  logic [27:0] product_ll_3, product_hl_3, product_lh_3, product_hh_3;
  wire [TILE_BITS-1:0] sum_4 = TILE_BITS'(base_3) + TILE_BITS'({product_hh_3, product_ll_3}) +
      TILE_BITS'({product_hl_3, 11'd0}) +
      TILE_BITS'({product_lh_3, 17'd0});
  wire [ADDRESS_BITS-1:0] address_4 = sum_4[ADDRESS_BITS-1:0];
  always_ff @(posedge clk) begin
    valid_1 <= reads;
    k_1 <= k;
    row_1 <= k == 3'd4 ? 11'(row) : k == 3'd5 ? 11'(own_row) : row_moves ? next_row_group : group_row;
    col_1 <= k == 3'd4 ? 11'(col) : k == 3'd5 ? 11'(own_col) : col_moves ? next_col_group : group_col;
    columns_1 <= of_tiles ? level.cols : level.group_cols;
    first_1 <= of_tiles ? level.first_image : '0;
    unit_1 <= of_tiles ? 34'(stream.tiles_per_image) : stream.reference_bytes;
    base_1 <= of_tiles ? '0 : level.reference_address;
    step_rows_1 <= $signed(row_moves ? next_row : own_row) - $signed(row);
    step_cols_1 <= $signed(col_moves ? next_col : own_col) - $signed(col);

    valid_2 <= valid_1;
    k_2 <= k_1;
    number_2 <= 22'(row_1) * 22'(columns_1) + first_1 + 22'(col_1);
    unit_2 <= unit_1;
    base_2 <= base_1;
    step_rows_2 <= step_rows_1 * stream.row_scale;
    step_cols_2 <= step_cols_1;

    valid_3 <= valid_2;
    k_3 <= k_2;
    product_ll_3 <= 28'(number_2[10:0]) * 28'(unit_2[16:0]);
    product_hl_3 <= 28'(number_2[21:11]) * 28'(unit_2[16:0]);
    product_lh_3 <= 28'(number_2[10:0]) * 28'(unit_2[33:17]);
    product_hh_3 <= 28'(number_2[21:11]) * 28'(unit_2[33:17]);
    base_3 <= base_2;
    step_rows_3 <= step_rows_2;
    step_cols_3 <= step_cols_2;

    unique case (k_3)
      3'd0: begin
        write_image.references.address_0 <= address_4;
        write_image.references.rows_0 <= step_rows_3;
        write_image.references.cols_0 <= step_cols_3;
      end
      3'd1: begin
        write_image.references.address_1 <= address_4;
        write_image.references.rows_1 <= step_rows_3;
        write_image.references.cols_1 <= step_cols_3;
      end
      3'd2: begin
        write_image.references.address_2 <= address_4;
        write_image.references.rows_2 <= step_rows_3;
        write_image.references.cols_2 <= step_cols_3;
      end
      3'd3: begin
        write_image.references.address_3 <= address_4;
        write_image.references.rows_3 <= step_rows_3;
        write_image.references.cols_3 <= step_cols_3;
      end
      3'd4: write_image.tiles.first_tile <= sum_4;
      default: write_image.disparity_tile <= sum_4;
    endcase
    write <= valid_3 && k_3 == 3'd5;
    if (!rst_n) begin
      valid_1 <= 1'b0;
      valid_2 <= 1'b0;
      valid_3 <= 1'b0;
      write <= 1'b0;
    end
  end

  // The next level's division begins with the last address of this one.
  logic ends;  // the level that is written is the last
  always_ff @(posedge clk) begin
    axes_start <= 1'b0;
    done <= write && ends;
    unique case (state)
      IDLE:
      if (start) begin
        l <= '0;
        row <= view_row;
        col <= view_col;
        keys <= '0;
        axes_start <= 1'b1;
        state <= AXES;
      end
      AXES: begin
        k <= '0;
        if (axes_done) state <= ADDRESSES;
      end
      default: begin  // ADDRESSES
        k <= k + 3'd1;
        if (last_k) begin
          write_level <= l;
          write_image.row <= row;
          write_image.col <= col;
          write_image.tiles.keyed <= level.keyed;
          write_image.tiles.is_reference <= is_reference;
          write_image.references.keyed <= level.keyed;
          write_image.references.is_reference <= is_reference;
          keys[l] <= level.keyed && is_reference;
          ends <= last_level;
          l <= l + 3'd1;
          row <= parent_row;
          col <= parent_col;
          axes_start <= !last_level;
          state <= last_level ? IDLE : AXES;
        end
      end
    endcase
    if (!rst_n) begin
      state <= IDLE;
      done <= 1'b0;
      axes_start <= 1'b0;
    end
  end

endmodule

`default_nettype wire
