// Reading of the header, from any state, step by step: the next bytes are asked for; each byte goes on to its field, to its entry, to the CRC; fields,
// flags and entries are checked as the tables say, in the order of FIL-4, and the first error ends it. 64 bits.
//
// Clauses: FIL-1, FIL-2, FIL-3, FIL-4, FIL-5, EXT-1, EXT-2, EXT-4
// Engine: bmc 2
// Complete: any state and one step from it; the read of 16 bytes may give anything (read_port).
// Fault: hmlfc_header.sv / == header_bytes - 16'd1) state <= FIELDS / == header_bytes - 16'd1) state <= ENDS
// Fault: hmlfc_header.sv / height_field != 0 && cluster_rows / cluster_rows
// Fault: hmlfc_header.sv / vector_field, 8'd5 / 8'd1, 8'd5
// Fault: hmlfc_header.sv / 32'h82F6_3B78 / 32'h82F6_3B79
// Fault: hmlfc_header.sv / next_byte > most_keys / next_byte > 8'd1
// Fault: hmlfc_header.sv / 33'(low_half[32]) / 33'd0
// Fault: hmlfc_header.sv / flags[31:HMLFC_FEATURE_COUNT] != 0 || / flags[31:HMLFC_FEATURE_COUNT+1] != 0 ||
// Fault: hmlfc_header.sv / expected_offset > {1'b0, stream_bytes} / expected_offset > 65'd0
`include "hmlfc_tables.svh"

// In the place of the read.
module hmlfc_aligned_read #(parameter integer DATA_BITS = 64, parameter integer ADDRESS_BITS = 40) (
  input logic clk, input logic rst_n, input logic start, input logic [39:0] address, output logic idle, output logic done, output logic [127:0] bytes,
  output logic error, output logic request_valid, input logic request_ready, output logic [39:0] request_address, output logic [9:0] request_beats,
  input logic data_valid, input logic [DATA_BITS-1:0] data, input logic data_last, input logic data_error
);
  (* anyseq *) logic [181:0] any;
  wire [109:0] given = {rst_n, start, address, request_ready, data_valid, data, data_last, data_error};
  assign {idle, done, bytes, error, request_valid, request_address, request_beats} = any;
endmodule

module prove_header #(
  parameter integer DATA_BITS = 64
) (
  input logic clk, input logic start, input logic [39:0] stream_base, input logic [63:0] stream_bytes, input logic request_ready,
  input logic data_valid, input logic [DATA_BITS-1:0] data, input logic data_last, input logic data_error
);
  logic         done, chroma_444, request_valid;
  logic [5:0]   error;
  logic [8:0]   features;
  logic [12:0]  rows, cols;
  logic [16:0]  width, height;
  logic [3:0]   depth, tree_height;
  logic [1:0]   block_log2, vector_precision;
  logic [6:0]   window;
  logic [7:0]   cluster_rows, cluster_cols, row_scale;
  logic [2:0]   disparity_precision, motion_tile_log2, disparity_grid_log2;
  logic [383:0] levels;
  logic [63:0]  root_offset, root_size, group_offset, group_size, tile_offset, tile_size;
  logic [39:0]  request_address;
  logic [9:0]   request_beats;
  hmlfc_header #(.DATA_BITS(DATA_BITS)) dut (
    .clk(clk), .rst_n(1'b1), .start(start), .stream_base(stream_base), .stream_bytes(stream_bytes), .done(done), .error(error), .features(features),
    .rows(rows), .cols(cols), .width(width), .height(height), .depth(depth), .chroma_444(chroma_444), .block_log2(block_log2), .window(window),
    .cluster_rows(cluster_rows), .cluster_cols(cluster_cols), .tree_height(tree_height), .vector_precision(vector_precision),
    .disparity_precision(disparity_precision), .motion_tile_log2(motion_tile_log2), .disparity_grid_log2(disparity_grid_log2),
    .row_scale(row_scale), .levels(levels), .root_offset(root_offset), .root_size(root_size), .group_offset(group_offset),
    .group_size(group_size), .tile_offset(tile_offset), .tile_size(tile_size), .request_valid(request_valid), .request_ready(request_ready),
    .request_address(request_address), .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last),
    .data_error(data_error));
  (* hierconn *) wire [181:0] \dut.read.any ;
  (* hierconn *) wire [109:0] \dut.read.given ;
  (* hierconn *) wire [3:0] \dut.state ;
  (* hierconn *) wire [15:0] \dut.at ;
  (* hierconn *) wire [127:0] \dut.piece ;
  (* hierconn *) wire [351:0] \dut.fixed ;
  (* hierconn *) wire [23:0] \dut.level ;
  (* hierconn *) wire [767:0] \dut.section_bytes ;
  (* hierconn *) wire [31:0] \dut.crc ;
  (* hierconn *) wire [31:0] \dut.stored_crc ;
  (* hierconn *) wire \dut.bad_level ;
  (* hierconn *) wire \dut.bad_table ;
  (* hierconn *) wire \dut.entry_came ;
  (* hierconn *) wire \dut.half_came ;
  (* hierconn *) wire [2:0] \dut.entry_type ;
  (* hierconn *) wire [4:0] \dut.section_byte ;
  (* hierconn *) wire [32:0] \dut.low_half ;
  (* hierconn *) wire [63:0] \dut.high_halves ;
  (* hierconn *) wire [64:0] \dut.expected_offset ;
  (* hierconn *) wire \dut.tiny ;
  (* hierconn *) wire \dut.beyond_end ;
  (* hierconn *) wire \dut.known_bad_field ;
  (* hierconn *) wire \dut.known_bad_feature ;
  localparam logic [3:0] IDLE = 0, READ = 1, BYTES = 2, FIELDS = 3, ENDS = 4, FINISH = 5;

  // The fields of FIL-1, by their offsets.
  wire [351:0] f = \dut.fixed ;
  wire [7:0]   profile = f[72 +: 8];
  wire [15:0]  size = f[80 +: 16];
  wire [31:0]  flags = f[96 +: 32];
  wire [7:0]   top = f[272 +: 8];
  wire         extended = profile == 1;
  wire [15:0]  h = 16'd44 + 16'd4 * (16'(top) + 16'd1);
  function automatic outside(input [31:0] value, input [31:0] least, input [31:0] most);
    outside = value < least || value > most;
  endfunction
  // EXT-2: in its range with its flag, else 0.
  function automatic wrong(input flag, input [7:0] value, input [7:0] least, input [7:0] most);
    wrong = flag ? outside(value, least, most) : value != 0;
  endfunction
  wire bad_range = outside(f[128 +: 16], 1, 4096) || outside(f[144 +: 16], 1, 4096) || outside(f[160 +: 32], 1, 65536) ||
                   outside(f[192 +: 32], 1, 65536) || outside(f[224 +: 8], 8, 12) || outside(f[232 +: 8], 0, 1) || outside(f[240 +: 8], 1, 3) ||
                   outside(f[248 +: 8], 0, 127) || f[256 +: 8] == 0 || f[264 +: 8] == 0 || outside(top, 0, 15) ||
                   (top != 0 && f[256 +: 8] == 1 && f[264 +: 8] == 1);
  wire bad_tool = wrong(extended && flags[2], f[280 +: 8], 1, 3) || wrong(extended && flags[3], f[288 +: 8], f[280 +: 8], 5) ||
                  wrong(extended && flags[1], f[296 +: 8], 5, 7) || wrong(extended && flags[3], f[304 +: 8], 2, 5) ||
                  (extended && flags[3] ? f[312 +: 8] == 8'h80 : f[312 +: 8] != 0) || f[320 +: 32] != 0;
  wire bad_size = size != h + (flags[9] ? 16'd120 : 16'd96) + 16'd4;
  wire bad_flags = !extended ? flags != 0 : (flags >> 10) != 0 || (!flags[1] && (flags[2] || flags[3] || flags[4] || flags[5]));

  // The byte that comes, in its entry of a level.
  wire [7:0]  value = \dut.piece [7:0];
  wire        of_level = \dut.at >= 44 && \dut.at < h;
  wire [1:0]  of_entry = \dut.at [1:0];
  wire        may_key = flags[7] && \dut.at >= 48;
  wire        wrong_byte = of_entry < 2 ? value == 0 : of_entry == 2 ? value > 8'(may_key) : value != 0;
  wire        of_section = \dut.at >= h && \dut.at < size - 16'd4;
  wire        covered = \dut.at < 12 || \dut.at < size - 16'd4;
  // FIL-5, by division of the bits that come by the polynomial, the highest power in bit 0.
  function automatic [31:0] crc_of(input [31:0] crc, input [7:0] by);
    reg [31:0] rest;
    reg first;
    rest = crc;
    for (integer i = 0; i < 8; i++) begin
      first = rest[0] ^ by[i];
      rest = {1'b0, rest[31:1]};
      for (integer p = 0; p < 32; p++) rest[31 - p] = rest[31 - p] ^ (first && ((32'h1EDC6F41 >> p) & 32'd1) != 0);
    end
    crc_of = rest;
  endfunction
  wire [191:0] entry = \dut.section_bytes [767:576];

  // What a step makes of it.
  logic         was = 1'b0;
  logic [3:0]   next_state;
  logic [15:0]  next_at;
  logic [351:0] next_fixed;
  logic [383:0] next_levels;
  logic [23:0]  next_level;
  logic [767:0] next_sections;
  logic [127:0] next_piece;
  logic [31:0]  next_crc, next_stored;
  logic [5:0]   next_error;
  logic         next_bad_level, next_bad_table, next_came, next_half, next_tiny, next_beyond, next_range, next_flags, next_done;
  logic [4:0]   next_byte;
  logic [2:0]   next_type;
  logic [32:0]  next_low;
  logic [63:0]  next_high;
  logic [64:0]  next_offset;
  wire          starts = \dut.state == IDLE && start;
  wire          comes = \dut.state == BYTES;
  wire          magic_ends = \dut.at == 13;
  wire [5:0]    first_error = f[63:0] != 64'h0A0D_4346_4C4D_4889 ? 6'(HMLFC_ERROR_BAD_MAGIC) : f[64 +: 8] != 1 ? 6'(HMLFC_ERROR_BAD_VERSION) :
                              size < 148 || \dut.beyond_end ? 6'(HMLFC_ERROR_TRUNCATED) : 6'd0;
  wire [5:0]    field_error = \dut.stored_crc != ~\dut.crc ? 6'(HMLFC_ERROR_BAD_HEADER_CRC) : profile > 1 ? 6'(HMLFC_ERROR_BAD_PROFILE) :
                              \dut.known_bad_feature ? 6'(HMLFC_ERROR_BAD_FEATURE) :
                              \dut.known_bad_field || \dut.bad_level ? 6'(HMLFC_ERROR_BAD_HEADER_FIELD) : 6'd0;
  wire [5:0]    end_error = \dut.bad_table ? 6'(HMLFC_ERROR_BAD_SECTION_TABLE) : \dut.expected_offset > stream_bytes ? 6'(HMLFC_ERROR_TRUNCATED) :
                            \dut.expected_offset < stream_bytes ? 6'(HMLFC_ERROR_TRAILING_BYTES) : 6'd0;
  wire          read_done = \dut.read.any [180];
  wire          read_error = \dut.read.any [51];
  wire          nothing = \dut.at == 0 && \dut.tiny ;
  always @(posedge clk) begin
    was <= 1'b1;
    next_tiny <= stream_bytes < 12;
    next_beyond <= stream_bytes < size;
    next_range <= bad_range || bad_tool || bad_size;
    next_flags <= bad_flags;
    next_done <= \dut.state == FINISH;
    next_at <= starts ? 16'd0 : \dut.at + 16'(comes);
    next_piece <= \dut.state == READ && read_done ? \dut.read.any [179:52] : comes ? {8'd0, \dut.piece [127:8]} : \dut.piece ;
    next_fixed <= f;
    if (comes && \dut.at < 12) next_fixed[95:0] <= {value, f[95:8]};
    if (comes && \dut.at >= 12 && \dut.at < 44) next_fixed[351:96] <= {value, f[351:104]};
    next_level <= comes && of_level ? {value, \dut.level [23:8]} : \dut.level ;
    next_levels <= comes && of_level && of_entry == 2 ? {levels[359:0], value, \dut.level [23:8]} : levels;
    next_sections <= comes && covered ? {value, \dut.section_bytes [767:8]} : \dut.section_bytes ;
    next_crc <= starts ? 32'hFFFF_FFFF : comes && covered ? crc_of(\dut.crc , value) : \dut.crc ;
    next_stored <= comes ? {value, \dut.stored_crc [31:8]} : \dut.stored_crc ;
    next_bad_level <= !starts && (\dut.bad_level || (comes && of_level && wrong_byte));
    // Entries of sections: RIG's is the first, where it is.
    next_came <= comes && of_section && \dut.section_byte == 23;
    next_half <= \dut.entry_came ;
    next_byte <= comes && of_section ? (\dut.section_byte == 23 ? 5'd0 : \dut.section_byte + 5'd1) : comes && \dut.at < h ? 5'd0 : \dut.section_byte ;
    next_type <= comes && \dut.at < h ? (flags[9] ? 3'd5 : 3'd1) :
                 \dut.entry_came ? (\dut.entry_type == 5 ? 3'd1 : \dut.entry_type + 3'd1) : \dut.entry_type ;
    next_bad_table <= !(comes && \dut.at < h) && (\dut.bad_table || (\dut.entry_came && (entry[31:0] != \dut.entry_type || entry[127:64] != \dut.expected_offset )));
    next_low <= 33'(entry[95:64]) + 33'(entry[159:128]);
    next_high <= {entry[127:96], entry[191:160]};
    next_offset <= comes && \dut.at < h ? 65'(size) : \dut.half_came ? 65'(\dut.low_half ) + ((65'(\dut.high_halves [63:32]) + 65'(\dut.high_halves [31:0])) << 32) :
                   \dut.expected_offset ;
    next_error <= starts ? 6'd0 : error;
    next_state <= \dut.state ;
    case (\dut.state )
      IDLE: if (start) next_state <= READ;
      READ: begin
        if (nothing) {next_state, next_error} <= {FINISH, 6'(HMLFC_ERROR_TRUNCATED)};
        if (read_done) {next_state, next_error} <= read_error ? {FINISH, 6'(HMLFC_ERROR_BUS_ERROR)} : {BYTES, 6'd0};
      end
      BYTES: begin
        if (\dut.at [3:0] == 15) next_state <= READ;
        if (\dut.at > 12 && \dut.at == size - 16'd1) next_state <= FIELDS;
        if (magic_ends && first_error != 0) {next_state, next_error} <= {FINISH, first_error};
      end
      FIELDS: {next_state, next_error} <= field_error != 0 ? {FINISH, field_error} : {ENDS, error};
      ENDS: {next_state, next_error} <= {FINISH, end_error != 0 ? end_error : error};
      default: next_state <= IDLE;
    endcase
  end
  always @* begin
    assume (\dut.state <= FINISH);
    assert (\dut.read.given == {1'b1, \dut.state == READ && \dut.read.any [181] && !read_done && !nothing, stream_base + 40'(\dut.at ), request_ready, data_valid,
                                data, data_last, data_error});
    assert ({request_valid, request_address, request_beats} == \dut.read.any [50:0]);
    assert ({features, rows, cols, width, height, depth} == {flags[8:0], f[128 +: 13], f[144 +: 13], f[160 +: 17], f[192 +: 17], f[224 +: 4]});
    assert ({chroma_444, block_log2, window, cluster_rows, cluster_cols, tree_height} == {f[232], f[240 +: 2], f[248 +: 7], f[256 +: 8], f[264 +: 8], top[3:0]});
    assert ({vector_precision, disparity_precision, motion_tile_log2, disparity_grid_log2, row_scale} ==
            {f[280 +: 2], f[288 +: 3], f[296 +: 3], f[304 +: 3], f[312 +: 8]});
    // The last four entries of 24 bytes are TOP, ROOT, GROUP and TILE.
    assert ({root_offset, root_size, group_offset, group_size} == {\dut.section_bytes [256 +: 64], \dut.section_bytes [320 +: 64],
                                                                   \dut.section_bytes [448 +: 64], \dut.section_bytes [512 +: 64]});
    assert ({tile_offset, tile_size} == {entry[127:64], entry[191:128]});
    if (was) begin
      assert (\dut.state == next_state);
      assert (error == next_error);
      assert (done == next_done);
      assert (\dut.at == next_at);
      assert (\dut.piece == next_piece);
      assert (f == next_fixed);
      assert (\dut.level == next_level);
      assert (levels == next_levels);
      assert (\dut.section_bytes == next_sections);
      assert (\dut.crc == next_crc);
      assert (\dut.stored_crc == next_stored);
      assert (\dut.bad_level == next_bad_level);
      assert (\dut.tiny == next_tiny);
      assert (\dut.beyond_end == next_beyond);
      assert (\dut.known_bad_field == next_range);
      assert (\dut.known_bad_feature == next_flags);
      assert (\dut.entry_came == next_came);
      assert (\dut.half_came == next_half);
      assert (\dut.section_byte == next_byte);
      assert (\dut.entry_type == next_type);
      assert (\dut.bad_table == next_bad_table);
      assert (\dut.low_half == next_low);
      assert (\dut.high_halves == next_high);
      assert (\dut.expected_offset == next_offset);
    end
  end
endmodule
