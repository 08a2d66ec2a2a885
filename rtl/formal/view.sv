// The images of a view, from any state, step by step: level after level the axes are asked for the image's row and column, then the references of MOT-7
// and the image's own tiles are numbered and become addresses, and the parent is next; what is written for a level is what its addresses are.
//
// Clauses: DEC-1, STR-3, STR-5, EXT-4, MOT-7, MOT-8, IDX-1
// Engine: bmc 2
// Complete: any state and one step from it; the axes may give anything (proof group_axis).
// Fault: hmlfc_view.sv / distance_col >= distance_row / distance_col > distance_row
// Fault: hmlfc_view.sv / k == 3'd3 || (k == 3'd1 && beside_first) / k == 3'd3 || (k == 3'd1 && !beside_first)
// Fault: hmlfc_view.sv / TILE_BITS'({product_lh_3, 17'd0}) / TILE_BITS'({product_lh_3, 16'd0})
// Fault: hmlfc_view.sv / step_rows_1 * stream.row_scale / step_rows_1 * $signed({1'b0, stream.row_scale})
// Fault: hmlfc_view.sv / keys[l] <= level.keyed && is_reference / keys[l] <= level.keyed
// Fault: hmlfc_view.sv / row <= parent_row / row <= parent_col

// In the place of an axis.
module hmlfc_group_axis (
  input logic clk, input logic rst_n, input logic start, input logic [9:0] at, input logic [10:0] count, input logic [7:0] size,
  input logic [10:0] groups, input logic balanced, input logic [7:0] cluster, output logic done, output logic [10:0] group,
  output logic [9:0] reference_at, output logic [10:0] next_group, output logic [9:0] next_reference_at, output logic [9:0] parent
);
  (* anyseq *) logic [52:0] any;
  wire [50:0] given = {rst_n, start, at, count, size, groups, balanced, cluster};
  assign {done, group, reference_at, next_group, next_reference_at, parent} = any;
endmodule

module prove_view (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic [983:0] levels, input logic start, input logic [9:0] view_row,
  input logic [9:0] view_col
);
  hmlfc_pkg::config_t stream;
  hmlfc_pkg::level_t level;
  hmlfc_pkg::image_t image;
  assign stream = stream_bits;
  logic         done, write;
  logic [7:0]   keys;
  logic [2:0]   write_level;
  logic [383:0] write_image;
  assign image = write_image;
  hmlfc_view dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .levels(levels), .start(start), .view_row(view_row), .view_col(view_col), .done(done), .keys(keys),
    .write(write), .write_level(write_level), .write_image(write_image));
  (* hierconn *) wire [52:0] \dut.rows.any ;
  (* hierconn *) wire [50:0] \dut.rows.given ;
  (* hierconn *) wire [52:0] \dut.cols.any ;
  (* hierconn *) wire [50:0] \dut.cols.given ;
  (* hierconn *) wire [1:0] \dut.state ;
  (* hierconn *) wire [2:0] \dut.l ;
  (* hierconn *) wire [2:0] \dut.k ;
  (* hierconn *) wire [9:0] \dut.row ;
  (* hierconn *) wire [9:0] \dut.col ;
  (* hierconn *) wire [122:0] \dut.level ;
  (* hierconn *) wire \dut.axes_start ;
  (* hierconn *) wire \dut.ends ;
  (* hierconn *) wire \dut.valid_1 ;
  (* hierconn *) wire \dut.valid_2 ;
  (* hierconn *) wire \dut.valid_3 ;
  (* hierconn *) wire [2:0] \dut.k_1 ;
  (* hierconn *) wire [2:0] \dut.k_2 ;
  (* hierconn *) wire [2:0] \dut.k_3 ;
  (* hierconn *) wire [10:0] \dut.row_1 ;
  (* hierconn *) wire [10:0] \dut.col_1 ;
  (* hierconn *) wire [10:0] \dut.columns_1 ;
  (* hierconn *) wire [21:0] \dut.first_1 ;
  (* hierconn *) wire [33:0] \dut.unit_1 ;
  (* hierconn *) wire [33:0] \dut.unit_2 ;
  (* hierconn *) wire [39:0] \dut.base_1 ;
  (* hierconn *) wire [39:0] \dut.base_2 ;
  (* hierconn *) wire [39:0] \dut.base_3 ;
  (* hierconn *) wire [9:0] \dut.step_rows_1 ;
  (* hierconn *) wire [9:0] \dut.step_cols_1 ;
  (* hierconn *) wire [9:0] \dut.step_cols_2 ;
  (* hierconn *) wire [9:0] \dut.step_cols_3 ;
  (* hierconn *) wire [17:0] \dut.step_rows_2 ;
  (* hierconn *) wire [17:0] \dut.step_rows_3 ;
  (* hierconn *) wire [21:0] \dut.number_2 ;
  (* hierconn *) wire [27:0] \dut.product_ll_3 ;
  (* hierconn *) wire [27:0] \dut.product_hl_3 ;
  (* hierconn *) wire [27:0] \dut.product_lh_3 ;
  (* hierconn *) wire [27:0] \dut.product_hh_3 ;
  assign level = \dut.level ;
  localparam logic [1:0] IDLE = 0, AXES = 1, ADDRESSES = 2;
  // Bits of the upper products: as the module computes them, as a netlist of it does, where the address needs no more.
`ifdef HMLFC_BASE_CASE
  localparam integer LH = 27, HH = 16;
`else
  localparam integer LH = 28, HH = 28;
`endif

  // K0 is in group (i, j), the neighbour in (i', j'): MOT-7.
  wire [10:0] i = \dut.rows.any [51:41], i_other = \dut.rows.any [30:20], j = \dut.cols.any [51:41], j_other = \dut.cols.any [30:20];
  wire [9:0]  rk = \dut.rows.any [40:31], rk_other = \dut.rows.any [19:10], ck = \dut.cols.any [40:31], ck_other = \dut.cols.any [19:10];
  wire [9:0]  r = \dut.row , c = \dut.col ;
  wire        own = r == rk && c == ck;
  wire signed [11:0] to_row = $signed({2'b0, r}) - $signed({2'b0, rk});
  wire signed [11:0] to_col = $signed({2'b0, c}) - $signed({2'b0, ck});
  wire [11:0] rows_away = to_row < 0 ? -to_row : to_row;
  wire [11:0] cols_away = to_col < 0 ? -to_col : to_col;
  wire        h_first = cols_away >= rows_away;  // K1 is H, the one beside
  wire        other_col = \dut.k == 3 || \dut.k == (h_first ? 1 : 2);
  wire        other_row = \dut.k == 3 || \dut.k == (h_first ? 2 : 1);
  wire        of_image = \dut.k == 4;
  wire        of_tiles = \dut.k >= 4;
  wire        last = \dut.state == ADDRESSES && \dut.k == 5;
  wire        top = \dut.l == stream.tree_height;
  wire [43:0] address = 44'(\dut.base_3 ) + 44'(\dut.product_ll_3 ) + (44'(\dut.product_hl_3 ) << 11) + (44'(\dut.product_lh_3 [26:0]) << 17) +
                        (44'(\dut.product_hh_3 [15:0]) << 28);

  wire [23:0] place = {image.row, image.col, image.tiles.keyed, image.tiles.is_reference, image.references.keyed, image.references.is_reference};
  wire [67:0] reference_0 = {image.references.address_0, image.references.cols_0, image.references.rows_0};
  wire [67:0] reference_1 = {image.references.address_1, image.references.cols_1, image.references.rows_1};
  wire [67:0] reference_2 = {image.references.address_2, image.references.cols_2, image.references.rows_2};
  wire [67:0] reference_3 = {image.references.address_3, image.references.cols_3, image.references.rows_3};
  logic         was = 1'b0, was_reset = 1'b0;
  logic [1:0]   next_state;
  logic [2:0]   next_l, next_k, next_write_level, was_k_1, was_k_2, was_k;
  logic [9:0]   next_row, next_col, next_cols_1, next_rows_1, was_cols_1, was_cols_2;
  logic [122:0] next_level_bits;
  logic         next_start, next_ends, next_done, next_write, was_reads, was_1, was_2;
  logic [7:0]   next_keys;
  logic [10:0]  next_row_1, next_col_1, next_columns;
  logic [21:0]  next_first, next_number;
  logic [33:0]  next_unit, was_unit_1;
  logic [39:0]  next_base, was_base_1, was_base_2;
  logic [17:0]  next_rows_2, was_rows_2;
  logic [27:0]  next_ll, next_hl;
  logic [LH-1:0] next_lh;
  logic [HH-1:0] next_hh;
  logic [23:0]  next_place;  // row, column, and twice whether it is keyed and the reference
  logic [67:0]  next_0, next_1, next_2, next_3;  // address, columns and rows of each reference
  logic [43:0]  next_tile, next_disparity;
  always @(posedge clk) begin
    was <= rst_n;
    was_reset <= !rst_n;
    next_level_bits <= levels >> (123 * \dut.l );
    next_start <= (\dut.state == IDLE && start) || (last && !top);
    next_done <= write && \dut.ends ;
    {next_state, next_l, next_row, next_col, next_keys} <= {\dut.state , \dut.l , r, c, keys};
    next_k <= \dut.state == AXES ? 3'd0 : \dut.state == ADDRESSES ? \dut.k + 3'd1 : \dut.k ;
    {next_ends, next_write_level, next_place} <= {\dut.ends , write_level, place};
    {next_0, next_1, next_2, next_3, next_tile, next_disparity} <= {reference_0, reference_1, reference_2, reference_3, image.tiles.first_tile, image.disparity_tile};
    if (\dut.state == IDLE && start) {next_state, next_l, next_row, next_col, next_keys} <= {AXES, 3'd0, view_row, view_col, 8'd0};
    if (\dut.state == AXES && \dut.rows.any [52] && \dut.cols.any [52]) next_state <= ADDRESSES;
    if (last) begin
      {next_state, next_l, next_row, next_col} <= {top ? IDLE : AXES, \dut.l + 3'd1, \dut.rows.any [9:0], \dut.cols.any [9:0]};
      {next_ends, next_write_level} <= {top, \dut.l };
      next_keys <= (keys & ~(8'd1 << \dut.l )) | (8'(level.keyed && own) << \dut.l );
      next_place <= {r, c, {2{level.keyed, own}}};
    end
    // 1: whose number, among how many, from where; 2: the number; 3: the product's parts; 4: the address.
    {was_reads, was_1, was_2, was_k, was_k_1, was_k_2} <= {\dut.state == ADDRESSES, \dut.valid_1 , \dut.valid_2 , \dut.k , \dut.k_1 , \dut.k_2 };
    next_row_1 <= of_image ? 11'(r) : of_tiles ? 11'(rk) : other_row ? i_other : i;
    next_col_1 <= of_image ? 11'(c) : of_tiles ? 11'(ck) : other_col ? j_other : j;
    next_columns <= of_tiles ? level.cols : level.group_cols;
    next_first <= of_tiles ? level.first_image : 22'd0;
    next_unit <= of_tiles ? 34'(stream.tiles_per_image) : stream.reference_bytes;
    next_base <= of_tiles ? 40'd0 : level.reference_address;
    next_rows_1 <= (other_row ? rk_other : rk) - r;
    next_cols_1 <= (other_col ? ck_other : ck) - c;
    next_number <= 22'(\dut.row_1 ) * 22'(\dut.columns_1 ) + 22'(\dut.col_1 ) + \dut.first_1 ;
    next_rows_2 <= $signed(\dut.step_rows_1 ) * $signed(stream.row_scale);
    next_ll <= 28'(\dut.number_2 [10:0]) * 28'(\dut.unit_2 [16:0]);
    next_hl <= 28'(\dut.number_2 [21:11]) * 28'(\dut.unit_2 [16:0]);
    next_lh <= LH'(\dut.number_2 [10:0]) * LH'(\dut.unit_2 [33:17]);
    next_hh <= HH'(\dut.number_2 [21:11]) * HH'(\dut.unit_2 [33:17]);
    {was_unit_1, was_base_1, was_base_2, was_cols_1, was_cols_2, was_rows_2} <= {\dut.unit_1 , \dut.base_1 , \dut.base_2 , \dut.step_cols_1 , \dut.step_cols_2 ,
                                                                           \dut.step_rows_2 };
    next_write <= \dut.valid_3 && \dut.k_3 == 5;
    case (\dut.k_3 )
      0: next_0 <= {address[39:0], \dut.step_cols_3 , \dut.step_rows_3 };
      1: next_1 <= {address[39:0], \dut.step_cols_3 , \dut.step_rows_3 };
      2: next_2 <= {address[39:0], \dut.step_cols_3 , \dut.step_rows_3 };
      3: next_3 <= {address[39:0], \dut.step_cols_3 , \dut.step_rows_3 };
      4: next_tile <= address;
      default: next_disparity <= address;
    endcase
  end
  always @* begin
    assume (\dut.state <= ADDRESSES && (\dut.state != ADDRESSES || \dut.k <= 5));
    assert (\dut.rows.given == {rst_n, \dut.axes_start , r, level.rows, level.ref_rows, level.group_rows, stream.features.balanced_groups, stream.cluster_rows});
    assert (\dut.cols.given == {rst_n, \dut.axes_start , c, level.cols, level.ref_cols, level.group_cols, stream.features.balanced_groups, stream.cluster_cols});
    if (was_reset) assert (\dut.state == IDLE && {\dut.valid_1 , \dut.valid_2 , \dut.valid_3 , write, done, \dut.axes_start } == 0);
    if (was) begin
      assert ({\dut.state , \dut.l , \dut.k , r, c, keys} == {next_state, next_l, next_k, next_row, next_col, next_keys});
      assert (\dut.level == next_level_bits && {\dut.axes_start , \dut.ends , done, write} == {next_start, next_ends, next_done, next_write});
      assert ({\dut.valid_1 , \dut.valid_2 , \dut.valid_3 } == {was_reads, was_1, was_2} && {\dut.k_1 , \dut.k_2 , \dut.k_3 } == {was_k, was_k_1, was_k_2});
      if (was_reads) assert ({\dut.row_1 , \dut.col_1 , \dut.columns_1 , \dut.first_1 } == {next_row_1, next_col_1, next_columns, next_first});
      if (was_reads) assert ({\dut.unit_1 , \dut.base_1 , \dut.step_rows_1 , \dut.step_cols_1 } == {next_unit, next_base, next_rows_1, next_cols_1});
      assert (\dut.number_2 == next_number && \dut.step_rows_2 == next_rows_2);
      assert ({\dut.unit_2 , \dut.base_2 , \dut.base_3 } == {was_unit_1, was_base_1, was_base_2});
      assert ({\dut.step_cols_2 , \dut.step_cols_3 , \dut.step_rows_3 } == {was_cols_1, was_cols_2, was_rows_2});
      assert ({\dut.product_ll_3 , \dut.product_hl_3 , \dut.product_lh_3 [26:0], \dut.product_hh_3 [15:0]} == {next_ll, next_hl, next_lh[26:0], next_hh[15:0]});
      assert (write_level == next_write_level && place == next_place && image.tiles.first_tile == next_tile && image.disparity_tile == next_disparity);
      assert (reference_0 == next_0 && reference_1 == next_1 && reference_2 == next_2 && reference_3 == next_3);
    end
  end
endmodule
