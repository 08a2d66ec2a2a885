// Geometry of a stream, from any state, step by step: the limits of the unit; then planes, levels from the views up, and their places from the top
// down, each number from one product or quotient; the size of ROOT. What is derived goes into its field of `stream` and of its level, and stays there.
//
// Clauses: FIL-7, FIL-8, IDX-1, IDX-2, IDX-4, IDX-5, MOT-1, STR-1, STR-2, STR-3, STR-6, EXT-3
// Engine: bmc 2
// Memories: arrays
// Complete: any state and one step from it; products, quotients and sizes may be anything (proofs divide, multiply_add, plane_size).
// Fault: hmlfc_geometry.sv / width > 17'(MAX_SIDE) / width >= 17'(MAX_SIDE)
// Fault: hmlfc_geometry.sv / motion_tiles && chroma_motion / chroma_motion
// Fault: hmlfc_geometry.sv / l == tree_height[2:0] || entry[16] / entry[16]
// Fault: hmlfc_geometry.sv / GROUP_COLS: group_cols <= ceiling / GROUP_COLS: group_cols <= quotient
// Fault: hmlfc_geometry.sv / {images, reference_address} / {images, reference_base}
// Fault: hmlfc_geometry.sv / c = 44'd4095 / c = 44'd4096
`include "hmlfc_tables.svh"

// In the place of the divider, of the multiplier, of the sizes.
module hmlfc_divide #(parameter integer WIDTH = 22, parameter integer DIVISOR_BITS = WIDTH, parameter integer QUOTIENT_BITS = WIDTH) (
  input logic clk, input logic rst_n, input logic start, input logic [WIDTH-1:0] dividend, input logic [DIVISOR_BITS-1:0] divisor, output logic idle,
  output logic done, output logic [QUOTIENT_BITS-1:0] quotient
);
  (* anyseq *) logic [12:0] any;
  wire [22:0] given = {start, dividend, divisor};
  assign {idle, done, quotient} = any;
endmodule

module hmlfc_multiply_add #(parameter integer A_BITS = 34, parameter integer B_BITS = 22, parameter integer SUM_BITS = 44) (
  input logic clk, input logic rst_n, input logic start, input logic [A_BITS-1:0] a, input logic [B_BITS-1:0] b, input logic [SUM_BITS-1:0] c,
  output logic idle, output logic done, output logic [SUM_BITS-1:0] sum
);
  (* anyseq *) logic [45:0] any;
  wire [100:0] given = {start, a, b, c};
  assign {idle, done, sum} = any;
endmodule

module hmlfc_plane_size #(parameter integer BLOCK_LOG2 = 2) (
  input logic clk, input logic [14:0] width, input logic [14:0] height, input logic [2:0] motion_tile_log2, output logic [101:0] plane,
  output logic [10:0] tiles_y, output logic [61:0] motion_plane, output logic [9:0] motion_tiles_y
);
  (* anyseq *) logic [184:0] any;
  wire [32:0] given = {width, height, motion_tile_log2};
  assign {plane, tiles_y, motion_plane, motion_tiles_y} = any;
endmodule

module prove_geometry #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 12
) (
  input logic clk, input logic rst_n, input logic start, input logic [39:0] stream_base, input logic [39:0] reference_base, input logic [8:0] features,
  input logic [12:0] rows, input logic [12:0] cols, input logic [16:0] width, input logic [16:0] height, input logic [3:0] depth,
  input logic chroma_444, input logic [1:0] block_log2, input logic [6:0] window, input logic [7:0] cluster_rows, input logic [7:0] cluster_cols,
  input logic [3:0] tree_height, input logic [1:0] vector_precision, input logic [2:0] disparity_precision, input logic [2:0] motion_tile_log2,
  input logic [2:0] disparity_grid_log2, input logic [7:0] row_scale, input logic [383:0] entries, input logic [63:0] root_offset,
  input logic [63:0] root_size, input logic [63:0] group_offset, input logic [63:0] group_size, input logic [63:0] tile_offset,
  input logic [63:0] tile_size
);
  localparam integer L = hmlfc_pkg::LEVEL_BITS;
  hmlfc_pkg::config_t stream, expected;
  logic         done;
  logic [5:0]   error;
  logic [750:0] stream_bits;
  logic [983:0] levels;
  assign stream = stream_bits;
  hmlfc_geometry #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH)) dut (
    .clk(clk), .rst_n(rst_n), .start(start), .done(done), .error(error), .stream_base(stream_base), .reference_base(reference_base),
    .features(features), .rows(rows), .cols(cols), .width(width), .height(height), .depth(depth), .chroma_444(chroma_444),
    .block_log2(block_log2), .window(window), .cluster_rows(cluster_rows), .cluster_cols(cluster_cols), .tree_height(tree_height),
    .vector_precision(vector_precision), .disparity_precision(disparity_precision), .motion_tile_log2(motion_tile_log2),
    .disparity_grid_log2(disparity_grid_log2), .row_scale(row_scale), .level_entries(entries), .root_offset(root_offset), .root_size(root_size),
    .group_offset(group_offset), .group_size(group_size), .tile_offset(tile_offset), .tile_size(tile_size), .stream(stream_bits), .levels(levels));
  (* hierconn *) wire [12:0] \dut.divide.any ;
  (* hierconn *) wire [22:0] \dut.divide.given ;
  (* hierconn *) wire [45:0] \dut.multiply_add.any ;
  (* hierconn *) wire [100:0] \dut.multiply_add.given ;
  (* hierconn *) wire [184:0] \dut.plane_size.any ;
  (* hierconn *) wire [32:0] \dut.plane_size.given ;
  (* hierconn *) wire [4:0] \dut.state ;
  (* hierconn *) wire [4:0] \dut.following ;
  (* hierconn *) wire [2:0] \dut.l ;
  (* hierconn *) wire [1:0] \dut.age ;
  (* hierconn *) wire \dut.started ;
  (* hierconn *) wire [23:0] \dut.entry ;
  (* hierconn *) wire [122:0] \dut.placed ;
  (* hierconn *) wire [10:0] \dut.level_rows ;
  (* hierconn *) wire [10:0] \dut.level_cols ;
  (* hierconn *) wire [10:0] \dut.group_rows ;
  (* hierconn *) wire [10:0] \dut.group_cols ;
  (* hierconn *) wire [21:0] \dut.next_tile ;
  (* hierconn *) wire [21:0] \dut.images ;
  (* hierconn *) wire [39:0] \dut.reference_address ;
  localparam logic [4:0] IDLE = 0, TILES_Y = 1, TILES_CO = 2, TILES_CG = 3, MOTION_LUMA = 4, MOTION_CHROMA = 5, STRIPS_Y = 6, BYTES_Y = 7, STRIPS_C = 8,
    BYTES_C = 9, REFERENCE = 10, GROUP_ROWS = 11, GROUP_COLS = 12, PARENT_ROWS = 13, PARENT_COLS = 14, IMAGES = 15, GROUPS = 16, AREA = 17, TILES = 18,
    SIZES = 19, FINISH = 20;

  wire [4:0]    state = \dut.state ;
  wire [2:0]    l = \dut.l ;
  hmlfc_pkg::level_t placed;
  hmlfc_pkg::plane_t plane;
  hmlfc_pkg::motion_plane_t motion;
  logic [10:0]  tiles_y;
  logic [9:0]   motion_tiles_y;
  assign placed = \dut.placed ;
  assign {plane, tiles_y, motion, motion_tiles_y} = \dut.plane_size.any ;
  wire [43:0]   sum = \dut.multiply_add.any [43:0];
  wire [10:0]   ceiling = \dut.divide.any [10:0] + 11'd1;
  wire          divides = state >= GROUP_ROWS && state <= PARENT_COLS;
  wire          multiplies = state >= TILES_Y && state <= TILES && !divides;
  wire          ends = \dut.divide.any [11] || \dut.multiply_add.any [44];
  wire          chroma = state == TILES_CO || state == TILES_CG || state == MOTION_CHROMA || state == STRIPS_C;
  wire          halved = chroma && !chroma_444;
  wire [16:0]   half_width = (width + 17'd1) / 2;
  wire [16:0]   half_height = (height + 17'd1) / 2;
  wire          beyond = block_log2 != BLOCK_LOG2 || depth > MAX_DEPTH || width > 16384 || height > 16384 || rows > 1024 || cols > 1024 || tree_height > 7;
  wire          forks = state == PARENT_COLS || state == AREA;
  wire          top = l == tree_height[2:0];

  // What is divided, rounded up: STR-2 and STR-3; what is multiplied, and added.
  wire [10:0]   dividend = state == GROUP_ROWS || state == PARENT_ROWS ? \dut.level_rows : \dut.level_cols ;
  wire [7:0]    divisor = state == GROUP_ROWS ? \dut.entry [7:0] : state == GROUP_COLS ? \dut.entry [15:8] : state == PARENT_ROWS ? cluster_rows : cluster_cols;
  logic [99:0]  factors;
  always @* case (state)
    TILES_Y, TILES_CO, TILES_CG: factors = {34'(plane.tiles_x), 22'(tiles_y), 44'(\dut.next_tile )};
    MOTION_LUMA, MOTION_CHROMA: factors = {34'(motion.tiles_x), 22'(motion_tiles_y), 44'(\dut.next_tile )};
    STRIPS_Y, STRIPS_C: factors = {34'(plane.strips_x), 22'(plane.blocks_y), 44'd0};
    BYTES_Y, BYTES_C: factors = {sum[33:0], 22'd144, 44'd0};
    REFERENCE: factors = {stream.chroma_bytes, 22'd2, 44'(stream.luma_bytes)};
    IMAGES: factors = {34'(placed.rows), 22'(placed.cols), 44'(\dut.images )};
    GROUPS: factors = {34'(placed.group_rows), 22'(placed.group_cols), 44'd0};
    AREA: factors = {stream.reference_bytes, sum[21:0], 44'(\dut.reference_address )};
    default: factors = {34'(stream.tiles_per_image), \dut.images , 44'd4095};
  endcase

  logic         first = 1'b1, was = 1'b0, was_reset = 1'b0, next_done, next_started;
  logic [1:0]   next_age;
  logic [4:0]   next_state;
  logic [2:0]   next_l;
  logic [5:0]   next_error;
  logic [29:0]  next_side;
  logic [23:0]  next_entry;
  logic [122:0] next_placed;
  logic [10:0]  next_level_rows, next_level_cols, next_group_rows, next_group_cols;
  logic [21:0]  next_next_tile, next_images;
  logic [39:0]  next_area;
  logic [983:0] next_levels;
  hmlfc_pkg::config_t next;
  integer       i;
  // Fields that no step changes are those of the header.
  always @* begin
    expected = stream_bits;
    {expected.features, expected.depth, expected.chroma_444, expected.tree_height, expected.window, expected.vector_precision} =
      {features, depth, chroma_444, tree_height[2:0], window, vector_precision};
    {expected.disparity_precision, expected.motion_tile_log2, expected.disparity_grid_log2, expected.row_scale} =
      {disparity_precision, motion_tile_log2, disparity_grid_log2, row_scale};
    {expected.rows, expected.cols, expected.cluster_rows, expected.cluster_cols} = {rows[10:0], cols[10:0], cluster_rows, cluster_cols};
    {expected.group_records, expected.tile_bytes} = {group_size[39:4], tile_size[39:0]};
  end
  always @(posedge clk) begin
    first <= 1'b0;
    was <= rst_n;
    was_reset <= !rst_n;
    next_side <= halved ? {half_width[14:0], half_height[14:0]} : {width[14:0], height[14:0]};
    for (i = 0; i < 8; i = i + 1) if (l == i) begin
      next_entry <= entries[24*i +: 24];
      next_placed <= levels[L*i +: L];
    end
    next_done <= state == FINISH;
    next_age <= state == IDLE || ends ? 2'd0 : \dut.age == 3 ? 2'd3 : \dut.age + 2'd1;
    next_started <= state != IDLE && !ends && (\dut.started || ((divides || multiplies) && \dut.age == 3));
    {next_state, next_l, next_error, next_levels} <= {state, l, error, levels};
    {next_level_rows, next_level_cols, next_group_rows, next_group_cols} <= {\dut.level_rows , \dut.level_cols , \dut.group_rows , \dut.group_cols };
    {next_next_tile, next_images, next_area, next} <= {\dut.next_tile , \dut.images , \dut.reference_address , stream_bits};
    if (state == IDLE) begin
      {next_l, next_next_tile, next_images, next_level_rows, next_level_cols, next_area} <= {3'd0, 44'd0, rows[10:0], cols[10:0], reference_base};
      next.root_address <= stream_base + root_offset[39:0];
      next.group_address <= stream_base + group_offset[39:0];
      next.tile_address <= stream_base + tile_offset[39:0];
      if (start) {next_state, next_error} <= {beyond ? FINISH : TILES_Y, beyond ? 6'(HMLFC_ERROR_LIMIT_EXCEEDED) : 6'd0};
    end
    if (ends && (divides || multiplies)) next_state <= state + 5'd1;
    if (state == SIZES) next_state <= FINISH;
    if (state == FINISH) next_state <= IDLE;
    // ROOT has 16 bytes for each 4096 tiles or part of them, GROUPS whole records.
    if (state == SIZES && (root_size != {28'd0, sum[43:12], 4'd0} || group_size[3:0] != 0)) next_error <= HMLFC_ERROR_BAD_SECTION_SIZE;
    if (ends) case (state)
      TILES_Y: {next.luma, next.chroma.first_tile, next_next_tile} <= {plane, sum[21:0], sum[21:0]};
      TILES_CO: {next.chroma[101:22], next.first_tile_cg, next_next_tile} <= {plane[101:22], sum[21:0], sum[21:0]};
      TILES_CG: {next.motion_luma.first_tile, next.tiles_per_image, next_next_tile} <= {3{sum[21:0]}};
      MOTION_LUMA: begin
        {next.motion_luma[61:22], next.motion_chroma.first_tile, next_next_tile} <= {motion[61:22], sum[21:0], sum[21:0]};
        if (stream.features.motion_tiles) next.tiles_per_image <= sum[21:0];
      end
      MOTION_CHROMA: begin
        next.motion_chroma[61:22] <= motion[61:22];
        if (stream.features.motion_tiles && stream.features.chroma_motion) next.tiles_per_image <= sum[21:0];
      end
      BYTES_Y: next.luma_bytes <= sum[33:0];
      BYTES_C: next.chroma_bytes <= sum[33:0];
      REFERENCE: next.reference_bytes <= sum[33:0];
      GROUP_ROWS: next_group_rows <= ceiling;
      GROUP_COLS: next_group_cols <= ceiling;
      PARENT_ROWS: begin
        next_level_rows <= ceiling;
        for (i = 0; i < 8; i = i + 1) if (l == i) next_levels[L*i+62 +: L-62] <=
          {\dut.level_rows , \dut.level_cols , \dut.entry [7:0], \dut.entry [15:8], \dut.group_rows , \dut.group_cols , top || \dut.entry [16]};
      end
      PARENT_COLS: begin
        next_level_cols <= ceiling;
        {next_state, next_l} <= top ? {IMAGES, l} : {GROUP_ROWS, l + 3'd1};
      end
      IMAGES: begin
        next_images <= sum[21:0];
        for (i = 0; i < 8; i = i + 1) if (l == i) next_levels[L*i +: 62] <= {\dut.images , \dut.reference_address };
      end
      AREA: {next_area, next_l, next_state} <= {sum[39:0], l - 3'd1, l == 0 ? TILES : IMAGES};
      default: ;
    endcase
  end
  always @* begin
    assume (state <= FINISH);
`ifdef HMLFC_BASE_CASE
    if (first && (divides || multiplies) && !forks) assume (\dut.following == state + 5'd1);  // a netlist has a register of it
`endif
    assert (\dut.divide.given [22] == (divides && \dut.age == 3 && !\dut.started && \dut.divide.any [12]));
    if (divides) assert (\dut.divide.given [21:0] == {dividend - 11'd1, 3'd0, divisor});
    assert (\dut.multiply_add.given [100] == (multiplies && \dut.age == 3 && !\dut.started && \dut.multiply_add.any [45]));
    if (multiplies) assert (\dut.multiply_add.given [99:0] == factors);
    assert (\dut.plane_size.given [2:0] == motion_tile_log2 && stream_bits == expected);
    if (was_reset) assert (state == IDLE && !done);
    if (was) begin
      assert (\dut.plane_size.given [32:3] == next_side && \dut.entry == next_entry && \dut.placed == next_placed);
      assert ({state, l, error, done} == {next_state, next_l, next_error, next_done} && {\dut.age , \dut.started } == {next_age, next_started});
      assert ({\dut.level_rows , \dut.level_cols , \dut.group_rows , \dut.group_cols } == {next_level_rows, next_level_cols, next_group_rows, next_group_cols});
      assert ({\dut.next_tile , \dut.images , \dut.reference_address } == {next_next_tile, next_images, next_area});
      assert (levels == next_levels);
      assert ({stream.luma, stream.chroma, stream.first_tile_cg, stream.motion_luma, stream.motion_chroma, stream.tiles_per_image, stream.luma_bytes,
               stream.chroma_bytes, stream.reference_bytes, stream.root_address, stream.group_address, stream.tile_address} ==
              {next.luma, next.chroma, next.first_tile_cg, next.motion_luma, next.motion_chroma, next.tiles_per_image, next.luma_bytes,
               next.chroma_bytes, next.reference_bytes, next.root_address, next.group_address, next.tile_address});
    end
  end
endmodule
