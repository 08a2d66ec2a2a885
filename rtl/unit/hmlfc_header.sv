// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Reads and checks the header of a stream (FIL-1 to FIL-4, EXT-1, EXT-2, EXT-4). Section RIG is skipped: only its entry
// is checked (RIG-1).
//
// `start` begins; `done` is high for one clock when `error` (annex A, 0 for none) and the fields are valid, which then
// hold. The checks are made in the order of FIL-4. Bytes come 16 at a time and are looked at one a clock; fields are
// little-endian (CNV-3).
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

    output logic [8:0] features,  // without camera_rig
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
    output logic [16*24-1:0] levels,  // {key_references, ref_cols, ref_rows} of level l at 24 * l
    output logic [63:0] root_offset,
    output logic [63:0] root_size,
    output logic [63:0] group_offset,
    output logic [63:0] group_size,
    output logic [63:0] tile_offset,
    output logic [63:0] tile_size,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  localparam int FIXED = HMLFC_HEADER_LEVELS;  // bytes before the level entries
  localparam int SECTION_BYTES = 96;
  localparam int PRELUDE = HMLFC_HEADER_FEATURE_FLAGS;  // bytes that say how long the header is
  localparam int RESERVED = HMLFC_HEADER_ROW_SCALE + 1;  // bytes from here to the level entries are 0
  localparam logic [HMLFC_FEATURE_COUNT-1:0] NEEDS_MOTION_TILES =
      HMLFC_FEATURE_COUNT'(1) << HMLFC_FEATURE_SUBPEL_VECTORS |
      HMLFC_FEATURE_COUNT'(1) << HMLFC_FEATURE_SHARED_DISPARITY |
      HMLFC_FEATURE_COUNT'(1) << HMLFC_FEATURE_TWO_REFERENCES |
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
    ENDS,
    FINISH
  } state_t;
  state_t state;

  // Pieces of 16 bytes, which lie within a beat or take two of 64 bits.
  localparam int BEAT_LOG2 = $clog2(DATA_BITS / 8);
  localparam int BEATS = DATA_BITS < 128 ? 2 : 1;
  logic read_start, reading, read_done, read_error;
  logic [127:0] bytes, piece;
  logic [15:0] at;  // the next byte of the header
  wire [255:0] beat = 256'(data);
  wire [127:0] came = DATA_BITS == 64 ? {beat[63:0], bytes[127:64]} :
      DATA_BITS == 256 && at[4] ? beat[255:128] : beat[127:0];
  always_ff @(posedge clk) begin
    read_done <= 1'b0;
    if (read_start) begin
      request.address <= (stream_base + ADDRESS_BITS'(at)) >> BEAT_LOG2 << BEAT_LOG2;
      request.beats <= 10'(BEATS);
      read_error <= 1'b0;
    end
    if (reading && response.valid) begin
      bytes <= came;
      read_error <= read_error || response.error;
      read_done <= response.last;
    end
    request.valid <= rst_n && (read_start || (request.valid && !response.ready));
    reading <= rst_n && (read_start || (reading && !(response.valid && response.last)));
  end

  logic [FIXED*8-1:0] fixed;
  logic [23:0] level;  // the last bytes of level entries that came
  logic [SECTION_BYTES*8-1:0] section_bytes;  // the last of them that came: TOP to TILE in the end
  logic [31:0] crc, stored_crc;
  wire [7:0] next_byte = piece[7:0];
  wire [15:0] header_bytes = fixed[HMLFC_HEADER_BYTES*8+:16];

  wire [7:0] profile = fixed[HMLFC_HEADER_PROFILE*8+:8];
  wire [31:0] flags = fixed[HMLFC_HEADER_FEATURE_FLAGS*8+:32];
  wire extended = profile == 8'd1;
  wire motion_tiles = flags[HMLFC_FEATURE_MOTION_TILES];
  wire shared = flags[HMLFC_FEATURE_SHARED_DISPARITY];
  wire rig = flags[HMLFC_FEATURE_CAMERA_RIG];
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
    bad_field = rows_field == 0 || rows_field > 16'(HMLFC_MAX_GRID) || cols_field == 0 ||
        cols_field > 16'(HMLFC_MAX_GRID);
    if (width_field == 0 || width_field > 32'(HMLFC_MAX_SIDE)) bad_field = 1'b1;
    if (view_height_field == 0 || view_height_field > 32'(HMLFC_MAX_SIDE)) bad_field = 1'b1;
    if (depth_field < 8'd8 || depth_field > 8'd12 || chroma_field > 8'd1) bad_field = 1'b1;
    if (block_field == 0 || block_field > 8'd3 || window_field > 8'(HMLFC_MAX_WINDOW)) bad_field = 1'b1;
    if (cluster_rows == 0 || cluster_cols == 0 || height_field > 8'(HMLFC_MAX_TREE_HEIGHT)) bad_field = 1'b1;
    if (height_field != 0 && cluster_rows == 8'd1 && cluster_cols == 8'd1) bad_field = 1'b1;
    if (extended) begin
      if (bad(flags[HMLFC_FEATURE_SUBPEL_VECTORS], vector_field, 8'd1, 8'd3)) bad_field = 1'b1;
      if (bad(shared, disparity_field, vector_field, 8'd5) || bad(motion_tiles, tile_field, 8'd5, 8'd7))
        bad_field = 1'b1;
      if (bad(shared, grid_field, 8'd2, 8'd5) || bad(shared, row_scale, 8'd0, 8'd255) || row_scale == 8'h80)
        bad_field = 1'b1;
    end else if (fixed[RESERVED*8-1:HMLFC_HEADER_VECTOR_PRECISION*8] != 0) bad_field = 1'b1;
    if (fixed[FIXED*8-1:RESERVED*8] != 0) bad_field = 1'b1;
    if (header_bytes != 16'(HMLFC_HEADER_BYTES_OF_ONE_LEVEL) + (rig ? 16'(HMLFC_HEADER_SECTION_BYTES) : 16'd0) +
        (16'(height_field) << 2)) bad_field = 1'b1;
  end
  wire bad_feature = extended ? flags[31:HMLFC_FEATURE_COUNT] != 0 ||
      (!motion_tiles && (flags[HMLFC_FEATURE_COUNT-1:0] & NEEDS_MOTION_TILES) != 0) : flags != 0;

  // Level entries, byte by byte as they come; the first is that of the top level.
  wire [15:0] levels_end = 16'(FIXED + 4) + (16'(height_field) << 2);
  wire in_levels = at >= 16'(FIXED) && at < levels_end;
  wire [1:0] level_byte = 2'(at - 16'(FIXED));
  wire [7:0] most_keys = flags[HMLFC_FEATURE_LEVEL_KEYS] && at >= 16'(FIXED + 4) ? 8'd1 : 8'd0;
  wire bad_byte = level_byte == 2'd3 ? next_byte != 0 : level_byte == 2'd2 ? next_byte > most_keys : next_byte == 0;
  logic bad_level;

  // Section entries, each when its last byte has come. Each section begins where the one before ends: the last end is
  // the greatest.
  wire in_sections = at >= levels_end && at < header_bytes - 16'd4;
  logic [4:0] section_byte;
  logic [2:0] entry_type;  // of the entry that comes
  logic entry_came, bad_table;
  wire [191:0] section = section_bytes[SECTION_BYTES*8-1-:192];
  wire [63:0] section_offset = section[127:64];
  wire [63:0] section_size = section[191:128];
  // The sum is made in two clocks, from its low half.
  logic half_came;
  logic [32:0] low_half;
  logic [63:0] high_halves;
  logic [64:0] expected_offset;

  // What is known long before it is asked for, a clock late.
  logic tiny, beyond_end, known_bad_field, known_bad_feature;
  always_ff @(posedge clk) begin
    tiny <= stream_bytes[63:4] == 0 && stream_bytes[3:0] < 4'(PRELUDE);
    beyond_end <= stream_bytes[63:16] == 0 && header_bytes > stream_bytes[15:0];
    known_bad_field <= bad_field;
    known_bad_feature <= bad_feature;
  end

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
  assign root_offset = section_bytes[1*192+64+:64];
  assign root_size = section_bytes[1*192+128+:64];
  assign group_offset = section_bytes[2*192+64+:64];
  assign group_size = section_bytes[2*192+128+:64];
  assign tile_offset = section_bytes[3*192+64+:64];
  assign tile_size = section_bytes[3*192+128+:64];

  assign read_start = state == READ && !reading && !read_done && !(at == 0 && tiny);

  always_ff @(posedge clk) begin
    done <= 1'b0;
    entry_came <= 1'b0;
    half_came <= entry_came;
    low_half <= {1'b0, section_offset[31:0]} + {1'b0, section_size[31:0]};
    high_halves <= {section_offset[63:32], section_size[63:32]};
    if (half_came)
      expected_offset <= {{1'b0, high_halves[63:32]} + {1'b0, high_halves[31:0]} + 33'(low_half[32]), low_half[31:0]};
    if (entry_came) begin
      entry_type <= entry_type == 3'd5 ? 3'd1 : entry_type + 3'd1;
      if (section[31:0] != 32'(entry_type) || {1'b0, section_offset} != expected_offset) bad_table <= 1'b1;
    end
    unique case (state)
      IDLE:
      if (start) begin
        error <= '0;
        at <= '0;
        crc <= '1;
        bad_level <= 1'b0;
        state <= READ;
      end
      READ: begin
        // The prelude is complete (FIL-4); the rest is read as far as the header gives.
        if (at == 0 && tiny) begin
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
        if (at < 16'(PRELUDE)) fixed[PRELUDE*8-1:0] <= {next_byte, fixed[PRELUDE*8-1:8]};
        else if (at < 16'(FIXED)) fixed[FIXED*8-1:PRELUDE*8] <= {next_byte, fixed[FIXED*8-1:PRELUDE*8+8]};
        if (in_levels) begin
          level <= {next_byte, level[23:8]};
          if (level_byte == 2'd2) levels <= {levels[15*24-1:0], next_byte, level[23:8]};
          if (bad_byte) bad_level <= 1'b1;
        end
        if (in_sections) begin
          section_byte <= section_byte == 5'd23 ? 5'd0 : section_byte + 5'd1;
          entry_came <= section_byte == 5'd23;
        end else if (at < levels_end) begin
          section_byte <= '0;
          entry_type <= rig ? 3'd5 : 3'd1;
          bad_table <= 1'b0;
          expected_offset <= 65'(header_bytes);
        end
        if (at < 16'(PRELUDE) || at < header_bytes - 16'd4) begin
          crc <= crc32c(crc, next_byte);
          section_bytes <= {next_byte, section_bytes[SECTION_BYTES*8-1:8]};
        end
        stored_crc <= {next_byte, stored_crc[31:8]};
        if (at[3:0] == 4'd15) state <= READ;
        if (at > 16'(PRELUDE) && at == header_bytes - 16'd1) state <= FIELDS;
        if (at == 16'(PRELUDE + 1)) begin  // also where header_bytes ends here
          if (fixed[63:0] != HMLFC_MAGIC) begin
            error <= HMLFC_ERROR_BAD_MAGIC;
            state <= FINISH;
          end else if (fixed[HMLFC_HEADER_VERSION*8+:8] != 8'(HMLFC_VERSION)) begin
            error <= HMLFC_ERROR_BAD_VERSION;
            state <= FINISH;
          end else if (header_bytes < 16'(HMLFC_HEADER_BYTES_OF_ONE_LEVEL) || beyond_end) begin
            error <= HMLFC_ERROR_TRUNCATED;
            state <= FINISH;
          end
        end
      end
      FIELDS: begin
        state <= ENDS;
        if (stored_crc != ~crc) error <= HMLFC_ERROR_BAD_HEADER_CRC;
        else if (profile > 8'd1) error <= HMLFC_ERROR_BAD_PROFILE;
        else if (known_bad_feature) error <= HMLFC_ERROR_BAD_FEATURE;
        else if (known_bad_field || bad_level) error <= HMLFC_ERROR_BAD_HEADER_FIELD;
        if (stored_crc != ~crc || profile > 8'd1 || known_bad_feature || known_bad_field || bad_level) state <= FINISH;
      end
      ENDS: begin
        if (bad_table) error <= HMLFC_ERROR_BAD_SECTION_TABLE;
        else if (expected_offset > {1'b0, stream_bytes}) error <= HMLFC_ERROR_TRUNCATED;
        else if (expected_offset != {1'b0, stream_bytes}) error <= HMLFC_ERROR_TRAILING_BYTES;
        state <= FINISH;
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

`default_nettype wire
