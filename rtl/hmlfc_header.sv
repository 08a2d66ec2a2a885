`include "hmlfc_tables.svh"

// Reads and checks the header of a stream (FIL-1 to FIL-4, EXT-1, EXT-2, EXT-4).
//
// `start` begins; `done` is high for one clock when `error` (annex A, 0 for none) and the fields are valid, which then hold. The checks
// are made in the order of FIL-4. Bytes come 16 at a time and are looked at one a clock; fields are little-endian (CNV-3).
module hmlfc_header #(
    parameter int DATA_BITS = 128,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic start,
    input logic [ADDRESS_BITS-1:0] stream_base,
    input logic [63:0] stream_bytes,
    output logic done,
    output logic [5:0] error,

    output logic [8:0] features,
    output logic [12:0] rows,
    output logic [12:0] cols,
    output logic [16:0] width,
    output logic [16:0] height,
    output logic [3:0] depth,
    output logic chroma_444,
    output logic [1:0] block_log2,
    output logic [6:0] window,
    output logic [7:0] cluster_rows,
    output logic [7:0] cluster_cols,
    output logic [3:0] tree_height,
    output logic [1:0] vector_precision,
    output logic [2:0] disparity_precision,
    output logic [2:0] motion_tile_log2,
    output logic [2:0] disparity_grid_log2,
    output logic [7:0] row_scale,
    output logic [16*24-1:0] levels,  // {key_references, ref_cols, ref_rows} from the top level on
    output logic [63:0] root_offset,
    output logic [63:0] root_size,
    output logic [63:0] group_offset,
    output logic [63:0] group_size,
    output logic [63:0] tile_offset,
    output logic [63:0] tile_size,

    output logic request_valid,
    input logic request_ready,
    output logic [ADDRESS_BITS-1:0] request_address,
    output logic [9:0] request_beats,
    input logic data_valid,
    input logic [DATA_BITS-1:0] data,
    input logic data_last,
    input logic data_error
);

  localparam int FIXED = HMLFC_HEADER_LEVELS;  // bytes before the level entries
  localparam int LEVEL_BYTES = 64;
  localparam int SECTION_BYTES = 96;
  localparam int PRELUDE = HMLFC_HEADER_FEATURE_FLAGS;  // bytes that say how long the header is
  localparam int RESERVED = HMLFC_HEADER_ROW_SCALE + 1;  // bytes from here to the level entries are 0
  localparam logic [HMLFC_FEATURE_COUNT-1:0] NEEDS_MOTION_TILES = HMLFC_FEATURE_COUNT'(1) << HMLFC_FEATURE_SUBPEL_VECTORS |
      HMLFC_FEATURE_COUNT'(1) << HMLFC_FEATURE_SHARED_DISPARITY | HMLFC_FEATURE_COUNT'(1) << HMLFC_FEATURE_TWO_REFERENCES |
      HMLFC_FEATURE_COUNT'(1) << HMLFC_FEATURE_CHROMA_MOTION;

  // One byte into a CRC-32C (FIL-5).
  function automatic logic [31:0] crc32c(input logic [31:0] crc, input logic [7:0] byte_in);
    crc32c = crc ^ 32'(byte_in);
    for (int i = 0; i < 8; i++) crc32c = (crc32c >> 1) ^ (crc32c[0] ? 32'h82F6_3B78 : 32'd0);
  endfunction

  typedef enum logic [3:0] {
    IDLE,
    READ,
    BYTES,
    FIELDS,
    LEVELS,
    TABLE,
    ENDS,
    FINISH
  } state_t;
  state_t state;

  logic read_start, read_idle, read_done, read_error;
  logic [127:0] bytes, piece;
  logic [15:0] at;  // the next byte of the header
  hmlfc_aligned_read #(
      .DATA_BITS(DATA_BITS),
      .ADDRESS_BITS(ADDRESS_BITS)
  ) read (
      .clk,
      .rst_n,
      .start(read_start),
      .address(stream_base + ADDRESS_BITS'(at)),
      .idle(read_idle),
      .done(read_done),
      .bytes,
      .error(read_error),
      .request_valid,
      .request_ready,
      .request_address,
      .request_beats,
      .data_valid,
      .data,
      .data_last,
      .data_error
  );

  logic [FIXED*8-1:0] fixed;
  logic [LEVEL_BYTES*8-1:0] level_bytes;
  logic [SECTION_BYTES*8-1:0] section_bytes;  // the last of them that came
  logic [31:0] crc, stored_crc;
  wire [7:0] next_byte = piece[7:0];
  wire [15:0] header_bytes = fixed[HMLFC_HEADER_BYTES*8+:16];

  wire [7:0] profile = fixed[HMLFC_HEADER_PROFILE*8+:8];
  wire [31:0] flags = fixed[HMLFC_HEADER_FEATURE_FLAGS*8+:32];
  wire extended = profile == 8'd1;
  wire motion_tiles = flags[HMLFC_FEATURE_MOTION_TILES];
  wire shared = flags[HMLFC_FEATURE_SHARED_DISPARITY];
  wire [7:0] window_field = fixed[HMLFC_HEADER_WINDOW*8+:8];
  wire [7:0] height_field = fixed[HMLFC_HEADER_TREE_HEIGHT*8+:8];
  wire [31:0] width_field = fixed[HMLFC_HEADER_WIDTH*8+:32];
  wire [31:0] view_height_field = fixed[HMLFC_HEADER_HEIGHT*8+:32];
  wire [15:0] rows_field = fixed[HMLFC_HEADER_ROWS*8+:16];
  wire [15:0] cols_field = fixed[HMLFC_HEADER_COLS*8+:16];
  wire [7:0] depth_field = fixed[HMLFC_HEADER_DEPTH*8+:8];
  wire [7:0] chroma_field = fixed[HMLFC_HEADER_CHROMA_FORMAT*8+:8];
  wire [7:0] block_field = fixed[HMLFC_HEADER_BLOCK_LOG2*8+:8];
  wire [7:0] vector_field = fixed[HMLFC_HEADER_VECTOR_PRECISION*8+:8];
  wire [7:0] disparity_field = fixed[HMLFC_HEADER_DISPARITY_PRECISION*8+:8];
  wire [7:0] tile_field = fixed[HMLFC_HEADER_MOTION_TILE_LOG2*8+:8];
  wire [7:0] grid_field = fixed[HMLFC_HEADER_DISPARITY_GRID_LOG2*8+:8];

  // 0 where its tool is not used, else in an interval (EXT-2).
  function automatic logic bad(input logic used, input logic [7:0] field, input logic [7:0] lo, input logic [7:0] hi);
    bad = used ? field < lo || field > hi : field != 0;
  endfunction

  // The fields from rows to the reserved bytes, and the header's size: one error, bad_header_field, for all.
  logic bad_field;
  always_comb begin
    bad_field = rows_field == 0 || rows_field > 16'(HMLFC_MAX_GRID) || cols_field == 0 || cols_field > 16'(HMLFC_MAX_GRID);
    if (width_field == 0 || width_field > 32'(HMLFC_MAX_SIDE)) bad_field = 1'b1;
    if (view_height_field == 0 || view_height_field > 32'(HMLFC_MAX_SIDE)) bad_field = 1'b1;
    if (depth_field < 8'd8 || depth_field > 8'd12 || chroma_field > 8'd1) bad_field = 1'b1;
    if (block_field == 0 || block_field > 8'd3 || window_field > 8'(HMLFC_MAX_WINDOW)) bad_field = 1'b1;
    if (cluster_rows == 0 || cluster_cols == 0 || height_field > 8'(HMLFC_MAX_TREE_HEIGHT)) bad_field = 1'b1;
    if (height_field != 0 && cluster_rows == 8'd1 && cluster_cols == 8'd1) bad_field = 1'b1;
    if (extended) begin
      if (bad(flags[HMLFC_FEATURE_SUBPEL_VECTORS], vector_field, 8'd1, 8'd3)) bad_field = 1'b1;
      if (bad(shared, disparity_field, vector_field, 8'd5) || bad(motion_tiles, tile_field, 8'd5, 8'd7)) bad_field = 1'b1;
      if (bad(shared, grid_field, 8'd2, 8'd5) || bad(shared, row_scale, 8'd0, 8'd255) || row_scale == 8'h80) bad_field = 1'b1;
    end else if (fixed[RESERVED*8-1:HMLFC_HEADER_VECTOR_PRECISION*8] != 0) bad_field = 1'b1;
    if (fixed[FIXED*8-1:RESERVED*8] != 0) bad_field = 1'b1;
    if (header_bytes != 16'(HMLFC_HEADER_BYTES_OF_ONE_LEVEL) + (16'(height_field) << 2)) bad_field = 1'b1;
  end
  wire bad_feature = extended ? flags[31:HMLFC_FEATURE_COUNT] != 0 || (!motion_tiles && (flags[HMLFC_FEATURE_COUNT-1:0] & NEEDS_MOTION_TILES) != 0) : flags != 0;

  // Level entries and section entries, one a clock.
  logic [3:0] entry;
  wire [31:0] level = level_bytes[32'(entry)*32+:32];
  wire [7:0] most_keys = flags[HMLFC_FEATURE_LEVEL_KEYS] && entry != 0 ? 8'd1 : 8'd0;
  wire bad_level = level[7:0] == 0 || level[15:8] == 0 || level[23:16] > most_keys || level[31:24] != 0;
  wire [191:0] section = section_bytes[32'(entry[1:0])*192+:192];
  wire [63:0] section_offset = section[127:64];
  wire [63:0] section_size = section[191:128];
  logic [64:0] expected_offset;

  assign features = flags[8:0];
  assign rows = rows_field[12:0];
  assign cols = cols_field[12:0];
  assign width = width_field[16:0];
  assign height = view_height_field[16:0];
  assign depth = depth_field[3:0];
  assign chroma_444 = chroma_field[0];
  assign block_log2 = block_field[1:0];
  assign window = window_field[6:0];
  assign cluster_rows = fixed[HMLFC_HEADER_CLUSTER_ROWS*8+:8];
  assign cluster_cols = fixed[HMLFC_HEADER_CLUSTER_COLS*8+:8];
  assign tree_height = height_field[3:0];
  assign vector_precision = vector_field[1:0];
  assign disparity_precision = disparity_field[2:0];
  assign motion_tile_log2 = tile_field[2:0];
  assign disparity_grid_log2 = grid_field[2:0];
  assign row_scale = fixed[HMLFC_HEADER_ROW_SCALE*8+:8];
  always_comb for (int i = 0; i < 16; i++) levels[i*24+:24] = level_bytes[i*32+:24];
  assign root_offset = section_bytes[1*192+64+:64];
  assign root_size = section_bytes[1*192+128+:64];
  assign group_offset = section_bytes[2*192+64+:64];
  assign group_size = section_bytes[2*192+128+:64];
  assign tile_offset = section_bytes[3*192+64+:64];
  assign tile_size = section_bytes[3*192+128+:64];

  assign read_start = state == READ && read_idle && !read_done && !(at == 0 && stream_bytes < 64'(PRELUDE));

  always_ff @(posedge clk) begin
    done <= 1'b0;
    case (state)
      IDLE:
      if (start) begin
        error <= '0;
        at <= '0;
        crc <= '1;
        state <= READ;
      end
      READ: begin
        // The prelude is complete (FIL-4); the rest is read as far as the header gives.
        if (at == 0 && stream_bytes < 64'(PRELUDE)) begin
          error <= HMLFC_ERROR_TRUNCATED;
          state <= FINISH;
        end
        if (read_done) begin
          piece <= bytes;
          error <= read_error ? HMLFC_ERROR_BUS_ERROR : 6'd0;
          state <= read_error ? FINISH : BYTES;
        end
      end
      BYTES: begin
        piece <= piece >> 8;
        at <= at + 16'd1;
        if (at < 16'(FIXED)) fixed[32'(at)*8+:8] <= next_byte;
        else if (at < 16'(FIXED + LEVEL_BYTES)) level_bytes[(32'(at)-FIXED)*8+:8] <= next_byte;
        if (at < 16'(PRELUDE) || at < header_bytes - 16'd4) begin
          crc <= crc32c(crc, next_byte);
          section_bytes <= {next_byte, section_bytes[SECTION_BYTES*8-1:8]};
        end
        stored_crc <= {next_byte, stored_crc[31:8]};
        if (at[3:0] == 4'd15) state <= READ;
        if (at == 16'(PRELUDE)) begin
          if (fixed[63:0] != HMLFC_MAGIC) begin
            error <= HMLFC_ERROR_BAD_MAGIC;
            state <= FINISH;
          end else if (fixed[HMLFC_HEADER_VERSION*8+:8] != 8'(HMLFC_VERSION)) begin
            error <= HMLFC_ERROR_BAD_VERSION;
            state <= FINISH;
          end else if (header_bytes < 16'(HMLFC_HEADER_BYTES_OF_ONE_LEVEL) || 64'(header_bytes) > stream_bytes) begin
            error <= HMLFC_ERROR_TRUNCATED;
            state <= FINISH;
          end
        end
        if (at >= 16'(PRELUDE) && at == header_bytes - 16'd1) state <= FIELDS;
      end
      FIELDS: begin
        entry <= '0;
        expected_offset <= 65'(header_bytes);
        state <= LEVELS;
        if (stored_crc != ~crc) error <= HMLFC_ERROR_BAD_HEADER_CRC;
        else if (profile > 8'd1) error <= HMLFC_ERROR_BAD_PROFILE;
        else if (bad_feature) error <= HMLFC_ERROR_BAD_FEATURE;
        else if (bad_field) error <= HMLFC_ERROR_BAD_HEADER_FIELD;
        if (stored_crc != ~crc || profile > 8'd1 || bad_feature || bad_field) state <= FINISH;
      end
      LEVELS: begin
        entry <= entry + 4'd1;
        if (bad_level) begin
          error <= HMLFC_ERROR_BAD_HEADER_FIELD;
          state <= FINISH;
        end else if (entry == tree_height) begin
          entry <= '0;
          state <= TABLE;
        end
      end
      TABLE: begin
        entry <= entry + 4'd1;
        expected_offset <= {1'b0, section_offset} + {1'b0, section_size};
        if (section[31:0] != 32'(entry) + 32'd1 || {1'b0, section_offset} != expected_offset) begin
          error <= HMLFC_ERROR_BAD_SECTION_TABLE;
          state <= FINISH;
        end else if (entry == 4'd3) begin
          entry <= '0;
          state <= ENDS;
        end
      end
      ENDS: begin
        entry <= entry + 4'd1;
        if (section_size > stream_bytes || section_offset > stream_bytes - section_size) begin
          error <= HMLFC_ERROR_TRUNCATED;
          state <= FINISH;
        end else if (entry == 4'd3) begin
          if (section_offset + section_size != stream_bytes) error <= HMLFC_ERROR_TRAILING_BYTES;
          state <= FINISH;
        end
      end
      default: begin  // FINISH
        done <= 1'b1;
        state <= IDLE;
      end
    endcase
    if (!rst_n) begin
      state <= IDLE;
      done <= 1'b0;
    end
  end

endmodule
