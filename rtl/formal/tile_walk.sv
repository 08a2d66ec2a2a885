// The walk from a tile's number to its record, from any state, step by step: root entry, rank and number of the group's record, the record, the end
// table's two entries, the record's place and size; each error in its place, what is kept of entries and records, and what is read.
//
// Clauses: IDX-3, IDX-4, IDX-5, IDX-6, IDX-7, CNV-6
// Engine: bmc 2
// Cut: aligned_read ram
// Complete: any state and one step from it; reads and memories may give anything (proofs ram, header).
// Fault: hmlfc_tile_walk.sv / number >= (NUMBER_BITS + 1)'(stream.group_records) / number > (NUMBER_BITS + 1)'(stream.group_records)
// Fault: hmlfc_tile_walk.sv / bytes[119:112] > 8'd32 / bytes[119:112] > 8'd33
// Fault: hmlfc_tile_walk.sv / product + 13'd7 / product + 13'd8
// Fault: hmlfc_tile_walk.sv / root_valid[root_slot] <= !read_error / root_valid[root_slot] <= 1'b1
// Fault: hmlfc_tile_walk.sv / end_at > 50'(stream.tile_bytes) / end_at >= 50'(stream.tile_bytes)
// Fault: hmlfc_tile_walk.sv / none <= end_offset <= begin_offset / none <= end_offset < begin_offset
`include "hmlfc_tables.svh"
`include "inside.svh"
module prove_tile_walk #(
  parameter integer DATA_BITS = 64,
  parameter integer GROUPS = 16,
  parameter integer ROOTS = 16,
  localparam integer S = $clog2(GROUPS),
  localparam integer R = $clog2(ROOTS),
  localparam integer T = hmlfc_pkg::TILE_BITS,
  localparam integer G = T - 6  // bits of a group's number
) (
  input logic clk, input logic rst_n, input logic [750:0] stream_bits, input logic flush, input logic start, input logic [T-1:0] tile,
  input logic request_ready, input logic data_valid, input logic [DATA_BITS-1:0] data, input logic data_last, input logic data_error
);
  hmlfc_pkg::config_t stream;
  assign stream = stream_bits;
  logic        idle, done, empty, request_valid;
  logic [5:0]  error;
  logic [39:0] record_address, request_address;
  logic [31:0] record_bytes;
  logic [9:0]  request_beats;
  hmlfc_tile_walk #(.DATA_BITS(DATA_BITS), .GROUPS(GROUPS), .ROOTS(ROOTS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .flush(flush), .start(start), .tile(tile), .idle(idle), .done(done), .error(error), .empty(empty),
    .record_address(record_address), .record_bytes(record_bytes), .request_valid(request_valid), .request_ready(request_ready),
    .request_address(request_address), .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last),
    .data_error(data_error));
  `SEEN(1, \dut.read.rst_n )
  `SEEN(1, \dut.read.start )
  `SEEN(40, \dut.read.address )
  `SEEN(1, \dut.read.idle )
  `SEEN(1, \dut.read.done )
  `SEEN(128, \dut.read.bytes )
  `SEEN(1, \dut.read.error )
  `SEEN(1, \dut.read.request_valid )
  `SEEN(1, \dut.read.request_ready )
  `SEEN(40, \dut.read.request_address )
  `SEEN(10, \dut.read.request_beats )
  `SEEN(1, \dut.read.data_valid )
  `SEEN(DATA_BITS, \dut.read.data )
  `SEEN(1, \dut.read.data_last )
  `SEEN(1, \dut.read.data_error )
  `SEEN(1, \dut.root_entries.write )
  `SEEN(R, \dut.root_entries.write_address )
  `SEEN(G+122-R, \dut.root_entries.write_data )
  `SEEN(1, \dut.root_entries.read )
  `SEEN(R, \dut.root_entries.read_address )
  `SEEN(G+122-R, \dut.root_entries.read_data )
  `SEEN(1, \dut.group_records.write )
  `SEEN(S, \dut.group_records.write_address )
  `SEEN(G+125-S, \dut.group_records.write_data )
  `SEEN(1, \dut.group_records.read )
  `SEEN(S, \dut.group_records.read_address )
  `SEEN(G+125-S, \dut.group_records.read_data )
  `SEEN(4, \dut.state )
  `SEEN(3, \dut.step )
  `SEEN(G, \dut.group )
  `SEEN(6, \dut.lane )
  `SEEN(ROOTS, \dut.root_valid )
  `SEEN(1, \dut.kept_root_valid )
  `SEEN(64, \dut.root_mask )
  `SEEN(64, \dut.root_first )
  `SEEN(GROUPS, \dut.group_valid )
  `SEEN(1, \dut.kept_valid )
  `SEEN(1, \dut.record_there )
  `SEEN(6, \dut.record_error )
  `SEEN(6, \dut.offset_bits )
  `SEEN(48, \dut.table_offset )
  `SEEN(64, \dut.tile_mask )
  `SEEN(1, \dut.place_set )
  `SEEN(64, \dut.counted )
  `SEEN(32, \dut.counts )
  `SEEN(7, \dut.count )
  `SEEN(37, \dut.number )
  `SEEN(1, \dut.number_outside )
  `SEEN(1, \dut.first )
  `SEEN(13, \dut.product )
  `SEEN(9, \dut.table_bytes )
  `SEEN(49, \dut.records_offset )
  `SEEN(1, \dut.table_outside )
  `SEEN(3, \dut.pair_shift )
  `SEEN(40, \dut.pair_offset )
  `SEEN(71, \dut.pair )
  `SEEN(6, \dut.pair_left )
  `SEEN(1, \dut.second )
  `SEEN(32, \dut.begin_offset )
  `SEEN(32, \dut.end_offset )
  `SEEN(50, \dut.end_at )
  `SEEN(40, \dut.begin_at )
  `SEEN(1, \dut.none )
  localparam logic [3:0] IDLE = 0, LOOK_UP = 1, CHOOSE = 2, ROOT = 3, RANK = 4, RECORD = 5, GROUP = 6, ENTRIES = 7, TABLE = 8, EXTENT = 9, PAIR = 10,
    BOUNDS = 11, FINISH = 12;
  wire [3:0]   state = \dut.state ;
  wire [S-1:0] slot = \dut.group [S-1:0];
  wire [R-1:0] root_slot = \dut.group [6 +: R];
  wire [127:0] bytes = \dut.read.bytes ;
  wire         came = \dut.read.done ;
  wire         usable = \dut.record_there && \dut.record_error == 0;
  wire         group_kept = \dut.kept_valid && \dut.group_records.read_data [G+124-S:125] == \dut.group [G-1:S];
  wire         root_kept = \dut.kept_root_valid && \dut.root_entries.read_data [G+121-R:128] == \dut.group [G-1:6+R];
  // What is read next, if anything: a root entry, a group's record, entries of its end table.
  wire         wants = state == CHOOSE ? !group_kept && !root_kept : state == RECORD ? \dut.place_set && !\dut.number_outside :
                       state == TABLE && usable && \dut.place_set && !\dut.table_outside ;
  wire         reads = wants && \dut.read.idle ;
  wire [39:0]  from = state == CHOOSE ? stream.root_address + 40'(\dut.group [G-1:6]) * 16 : state == RECORD ? stream.group_address + \dut.number [35:0] * 40'd16 :
                      stream.tile_address + \dut.pair_offset ;
  wire [ROOTS-1:0] kept_entry = state == ROOT && came;
  // Which bits are counted.
  wire         of_root = state == RANK || state == RECORD;
  wire [63:0]  mask = of_root ? \dut.root_mask : \dut.tile_mask ;
  wire [5:0]   place = of_root ? \dut.group [5:0] : \dut.lane ;
  wire [6:0]   entries = state == ENTRIES && \dut.step == 3 ? \dut.count : \dut.count == 0 ? 7'd0 : \dut.count - 7'd1;
  wire [31:0]  field = \dut.pair [31:0] & ((33'd1 << \dut.offset_bits ) - 1);
  wire         shifted = \dut.pair_left == 0;

  logic        was = 1'b0, was_reset = 1'b0, was_flush = 1'b0, n_done, n_empty, n_kept, n_kept_root, n_there, n_set, n_outside, n_first, n_table, n_second, n_none;
  logic [3:0]  n_state;
  logic [2:0]  n_step, n_pair_shift;
  logic [G-1:0] n_group;
  logic [5:0]  n_lane, n_error, n_record_error, n_offset_bits, n_left;
  logic [ROOTS-1:0] n_roots;
  logic [GROUPS-1:0] n_groups;
  logic [63:0] n_root_mask, n_root_first, n_tile_mask, n_counted;
  logic [47:0] n_table_offset;
  logic [31:0] n_counts, n_begin, n_end, n_bytes;
  logic [6:0]  n_count;
  logic [36:0] n_number;
  logic [12:0] n_product;
  logic [8:0]  n_table_bytes;
  logic [48:0] n_records;
  logic [39:0] n_pair_offset, n_begin_at, n_address;
  logic [70:0] n_pair;
  logic [49:0] n_end_at;
  integer      i;
  always @(posedge clk) begin
    was <= rst_n;
    was_reset <= !rst_n;
    was_flush <= !rst_n || flush;
    {n_state, n_done, n_step, n_group, n_lane, n_error, n_empty} <= {state, 1'b0, \dut.step + 3'd1, \dut.group , \dut.lane , error, empty};
    {n_kept, n_kept_root} <= {\dut.kept_valid , \dut.kept_root_valid };
    n_roots <= (\dut.root_valid & ~(kept_entry << root_slot)) | ((kept_entry & {ROOTS{!\dut.read.error }}) << root_slot);
    n_groups <= \dut.group_valid | (state == TABLE ? 1 << slot : 0);
    {n_root_first, n_root_mask, n_there, n_record_error} <= {\dut.root_first , \dut.root_mask , \dut.record_there , \dut.record_error };
    {n_offset_bits, n_table_offset, n_tile_mask, n_number, n_outside} <= {\dut.offset_bits , \dut.table_offset , \dut.tile_mask , \dut.number , \dut.number_outside };
    {n_first, n_product, n_table_bytes, n_records, n_table} <= {\dut.first , \dut.product , \dut.table_bytes , \dut.records_offset , \dut.table_outside };
    {n_pair_shift, n_pair_offset, n_pair, n_left, n_second} <= {\dut.pair_shift , \dut.pair_offset , \dut.pair , \dut.pair_left , \dut.second };
    {n_begin, n_end, n_end_at, n_begin_at, n_none} <= {\dut.begin_offset , \dut.end_offset , \dut.end_at , \dut.begin_at , \dut.none };
    {n_address, n_bytes} <= {record_address, record_bytes};
    n_set <= mask[place];
    n_counted <= state == ENTRIES && \dut.step == 0 ? mask : mask & ((65'd1 << place) - 1);
    for (i = 0; i < 8; i = i + 1) n_counts[4*i +: 4] <= ones_of_byte(\dut.counted [8*i +: 8]);
    n_count <= \dut.counts [3:0] + \dut.counts [7:4] + \dut.counts [11:8] + \dut.counts [15:12] + \dut.counts [19:16] + \dut.counts [23:20] + \dut.counts [27:24] +
      \dut.counts [31:28];
    if (state == IDLE && start) {n_state, n_group, n_lane, n_error, n_empty} <= {LOOK_UP, tile, 6'd0, 1'b0};
    if (state == LOOK_UP) {n_state, n_kept, n_kept_root} <= {CHOOSE, \dut.group_valid [slot], \dut.root_valid [root_slot]};
    if (state == CHOOSE) begin
      {n_there, n_record_error, n_offset_bits, n_table_offset, n_tile_mask} <= \dut.group_records.read_data [124:0];
      {n_root_first, n_root_mask, n_step} <= {\dut.root_entries.read_data [127:0], 3'd0};
      n_state <= group_kept ? ENTRIES : root_kept ? RANK : reads ? ROOT : CHOOSE;
    end
    if (state == ROOT && came) begin
      {n_root_first, n_root_mask, n_step, n_state} <= {bytes, 3'd0, RANK};
    end
    if (state == RANK && \dut.step == 3) n_number <= \dut.root_first [35:0] + 37'(\dut.count );
    if (state == RANK && \dut.step == 4) {n_outside, n_state} <= {\dut.root_first [63:36] != 0 || \dut.number >= stream.group_records, RECORD};
    if (state == RECORD) begin
      {n_there, n_record_error} <= {\dut.place_set , \dut.number_outside ? 6'(HMLFC_ERROR_BAD_ROOT_ENTRY) : 6'd0};
      if (\dut.read.idle ) n_state <= reads ? GROUP : TABLE;
    end
    if (state == GROUP && came) begin
      {n_offset_bits, n_table_offset, n_tile_mask, n_step, n_state} <= {bytes[117:0], 3'd0, ENTRIES};
      if (bytes[127:120] != 0 || bytes[119:112] < 1 || bytes[119:112] > 32) n_record_error <= HMLFC_ERROR_BAD_GROUP_RECORD;
    end
    if (state == ENTRIES) begin
      n_product <= 13'(entries) * 13'(\dut.offset_bits );
      if (\dut.step == 4) {n_table_bytes, n_first} <= {9'((14'(\dut.product ) + 14'd7) / 8), \dut.count == 0};
      if (\dut.step == 5) begin
        n_records <= 49'(\dut.table_offset ) + 49'(\dut.table_bytes );
        n_pair_offset <= \dut.table_offset [39:0] + 40'(\dut.product [12:3]);
        n_pair_shift <= \dut.product [2:0];
      end
      if (\dut.step == 6) n_table <= \dut.records_offset > stream.tile_bytes;
      if (\dut.step == 6 || !usable) n_state <= TABLE;
    end
    if (state == TABLE) begin
      if (reads) n_state <= EXTENT;
      else if (\dut.read.idle ) begin
        {n_state, n_done} <= {IDLE, 1'b1};
        if (\dut.record_there && \dut.record_error != 0) n_error <= \dut.record_error ;
        else if (\dut.record_there && \dut.place_set ) n_error <= HMLFC_ERROR_BAD_GROUP_RECORD;
        else n_empty <= 1'b1;
      end
    end
    if (state == EXTENT && came) {n_pair, n_left, n_second, n_state} <= {bytes[70:0], 3'd0, \dut.pair_shift , 1'b0, PAIR};
    if ((state == EXTENT || state == ROOT || state == GROUP) && came && \dut.read.error ) n_error <= HMLFC_ERROR_BUS_ERROR;
    if ((state == ROOT || state == GROUP) && came && \dut.read.error ) {n_state, n_done} <= {IDLE, 1'b1};
    if (state == PAIR) begin
      n_pair <= \dut.pair >> (\dut.pair_left >= 8 ? 6'd8 : \dut.pair_left );
      n_left <= \dut.pair_left >= 8 ? \dut.pair_left - 6'd8 : shifted ? \dut.offset_bits : 6'd0;
      if (shifted) {n_second, n_begin, n_end} <= {1'b1, \dut.second ? \dut.end_offset : 32'd0, field};
      if (shifted && (\dut.first || \dut.second )) n_state <= BOUNDS;
    end
    if (state == BOUNDS) begin
      {n_none, n_bytes, n_state} <= {\dut.end_offset <= \dut.begin_offset , \dut.end_offset - \dut.begin_offset , FINISH};
      n_end_at <= 50'(\dut.records_offset ) + 50'(\dut.end_offset );
      n_begin_at <= \dut.records_offset [39:0] + 40'(\dut.begin_offset );
    end
    if (state == FINISH) begin
      {n_address, n_done, n_state} <= {stream.tile_address + \dut.begin_at , 1'b1, IDLE};
      if (error == 0 && (\dut.none || \dut.end_at > stream.tile_bytes)) n_error <= HMLFC_ERROR_BAD_TILE_OFFSET;
    end
  end
  function [3:0] ones_of_byte(input [7:0] b);
    ones_of_byte = b[0] + b[1] + b[2] + b[3] + b[4] + b[5] + b[6] + b[7];
  endfunction
  always @* begin
    assume (state <= FINISH);
    assert (idle == (state == IDLE) && \dut.read.start == reads);
    if (reads) assert (\dut.read.address == from);
    assert ({request_valid, request_address, request_beats} == {\dut.read.request_valid , \dut.read.request_address , \dut.read.request_beats });
    assert ({\dut.read.rst_n , \dut.read.request_ready , \dut.read.data_valid , \dut.read.data , \dut.read.data_last , \dut.read.data_error } ==
            {rst_n, request_ready, data_valid, data, data_last, data_error});
    // Entries and records are kept as they come, each in its slot.
    assert (\dut.root_entries.read == (state == LOOK_UP) && \dut.root_entries.write == (state == ROOT && came));
    assert (\dut.group_records.read == (state == LOOK_UP) && \dut.group_records.write == (state == TABLE));
    assert ({\dut.root_entries.read_address , \dut.root_entries.write_address } == {2{root_slot}});
    assert ({\dut.group_records.read_address , \dut.group_records.write_address } == {2{slot}});
    assert (\dut.root_entries.write_data == {\dut.group [G-1:6+R], bytes});
    assert (\dut.group_records.write_data == {\dut.group [G-1:S], \dut.record_there , \dut.record_error , \dut.offset_bits , \dut.table_offset , \dut.tile_mask });
    if (was_reset) assert (state == IDLE && !done);
    if (was_flush) assert (\dut.root_valid == 0 && \dut.group_valid == 0);
    if (was && !was_flush) assert ({\dut.root_valid , \dut.group_valid } == {n_roots, n_groups});
    if (was) begin
      assert ({state, done, \dut.step , \dut.group , \dut.lane , error, empty} == {n_state, n_done, n_step, n_group, n_lane, n_error, n_empty});
      assert ({\dut.kept_valid , \dut.kept_root_valid , \dut.root_first , \dut.root_mask , \dut.record_there } == {n_kept, n_kept_root, n_root_first, n_root_mask, n_there});
      assert ({\dut.record_error , \dut.offset_bits , \dut.table_offset , \dut.tile_mask } == {n_record_error, n_offset_bits, n_table_offset, n_tile_mask});
      assert ({\dut.place_set , \dut.counted , \dut.counts , \dut.count } == {n_set, n_counted, n_counts, n_count});
      assert ({\dut.number , \dut.number_outside , \dut.first , \dut.product , \dut.table_bytes } == {n_number, n_outside, n_first, n_product, n_table_bytes});
      assert ({\dut.records_offset , \dut.table_outside , \dut.pair_shift , \dut.pair_offset } == {n_records, n_table, n_pair_shift, n_pair_offset});
      assert ({\dut.pair , \dut.pair_left , \dut.second , \dut.begin_offset , \dut.end_offset } == {n_pair, n_left, n_second, n_begin, n_end});
      assert ({\dut.end_at , \dut.begin_at , \dut.none , record_address, record_bytes} == {n_end_at, n_begin_at, n_none, n_address, n_bytes});
    end
  end
endmodule
