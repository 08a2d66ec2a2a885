// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Walks the index from a tile's number to its record (IDX-3 to IDX-7): three dependent reads at most (BND-1).
//
// `start` with `tile` begins a walk when `idle`. `done` is high for one clock when the result holds:
// `error` is the number of an error of annex A; without one, `empty` says that the tile has no record,
// else the record's `record_bytes` bytes begin at byte address `record_address`. The result keeps until
// the next start.
//
// ROOTS root entries and the records of GROUPS tile groups are kept, so that tiles of a tile group seen
// before cost one read, of the end table; `flush` forgets them. What a bus error brought is not kept.
// Masking, counting, products, sums and comparisons have a clock each; `step` numbers those between two reads.
module hmlfc_tile_walk #(
    parameter int DATA_BITS = 128,
    parameter int GROUPS = 16,  // tile groups, a power of two
    parameter int ROOTS = 16,  // root entries, a power of two
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic start,
    input logic [TILE_BITS-1:0] tile,
    output logic idle,
    output logic done,
    output logic [5:0] error,
    output logic empty,
    output logic [ADDRESS_BITS-1:0] record_address,
    output logic [31:0] record_bytes,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);


  localparam int GROUP_BITS = TILE_BITS - 6;
  localparam int SLOT_BITS = $clog2(GROUPS);
  localparam int TAG_BITS = GROUP_BITS - SLOT_BITS;
  localparam int ROOT_SLOT_BITS = $clog2(ROOTS);
  localparam int ROOT_TAG_BITS = GROUP_BITS - 6 - ROOT_SLOT_BITS;
  localparam int NUMBER_BITS = ADDRESS_BITS - 4;  // of group records

  typedef enum logic [3:0] {
    IDLE,
    LOOK_UP,
    CHOOSE,
    ROOT,
    RANK,
    RECORD,
    GROUP,
    ENTRIES,
    TABLE,
    EXTENT,
    PAIR,
    BOUNDS,
    FINISH
  } state_t;
  state_t state;
  logic [2:0] step;

  logic [GROUP_BITS-1:0] group;
  logic [5:0] lane;
  wire [SLOT_BITS-1:0] slot = group[SLOT_BITS-1:0];

  // Root entries, each of 64 tile groups: {tag, number of the first record, mask}.
  localparam int ROOT_BITS = ROOT_TAG_BITS + 128;
  wire [ROOT_SLOT_BITS-1:0] root_slot = group[6+:ROOT_SLOT_BITS];
  wire [ROOT_TAG_BITS-1:0] root_tag = group[GROUP_BITS-1-:ROOT_TAG_BITS];
  logic [ROOTS-1:0] root_valid;
  logic [ROOT_BITS-1:0] kept_root;  // the one in the slot
  logic kept_root_valid;
  logic [63:0] root_mask, root_first;

  // Records of tile groups: {tag, there is one, error, offset_bits, data, tile_mask}.
  localparam int RECORD_BITS = TAG_BITS + 1 + 6 + 6 + 48 + 64;
  logic [GROUPS-1:0] group_valid;
  logic [RECORD_BITS-1:0] kept;  // the one in the slot
  logic kept_valid;

  logic record_there;
  logic [5:0] record_error;
  logic [5:0] offset_bits;
  logic [47:0] table_offset;
  logic [63:0] tile_mask;

  wire group_hit = kept_valid && kept[RECORD_BITS-1-:TAG_BITS] == group[GROUP_BITS-1:SLOT_BITS];
  wire root_hit = kept_root_valid && kept_root[ROOT_BITS-1-:ROOT_TAG_BITS] == root_tag;

  logic read_start, read_idle, read_done, read_error;
  logic [ADDRESS_BITS-1:0] read_address;
  logic [127:0] bytes;
  hmlfc_aligned_read #(
      .DATA_BITS(DATA_BITS)
  ) read (
      .clk,
      .rst_n,
      .start(read_start),
      .address(read_address),
      .idle(read_idle),
      .done(read_done),
      .bytes,
      .error(read_error),
      .request,
      .response,
      .data
  );

  // The 1 bits of a mask, in three clocks, one mask a clock: all of them, or those below a bit, whose number is rank of
  // CNV-6.
  wire of_root = state == RANK || state == RECORD;
  wire whole = state == ENTRIES && step == 3'd0;
  wire [63:0] mask = of_root ? root_mask : tile_mask;
  wire [5:0] place = of_root ? group[5:0] : lane;
  logic place_set;  // the bit itself, with `counted`
  logic [63:0] counted;
  logic [8*4-1:0] counts;
  logic [6:0] count;
  always_ff @(posedge clk) begin
    place_set <= mask[place];
    counted <= whole ? mask : mask & ~(64'hFFFF_FFFF_FFFF_FFFF << place);
    for (int i = 0; i < 8; i++) begin
      counts[i*4+:4] <= ((4'(counted[i*8]) + 4'(counted[i*8+1])) + (4'(counted[i*8+2]) + 4'(counted[i*8+3]))) +
          ((4'(counted[i*8+4]) + 4'(counted[i*8+5])) + (4'(counted[i*8+6]) + 4'(counted[i*8+7])));
    end
    count <= ((7'(counts[0+:4]) + 7'(counts[4+:4])) + (7'(counts[8+:4]) + 7'(counts[12+:4]))) +
        ((7'(counts[16+:4]) + 7'(counts[20+:4])) + (7'(counts[24+:4]) + 7'(counts[28+:4])));
  end

  // IDX-4: the number of the tile group's record. root_first may be any 64-bit number; above NUMBER_BITS it is outside.
  logic [NUMBER_BITS:0] number;
  logic number_outside;

  // IDX-6: the end table and the two entries that bound the record, or the one, for the first.
  logic first;
  wire [6:0] first_entry = count == 7'd0 ? 7'd0 : count - 7'd1;
  logic [12:0] product;  // of a number of entries and offset_bits
  logic [8:0] table_bytes;
  logic [48:0] records_offset;
  logic table_outside;
  logic [2:0] pair_shift;
  logic [ADDRESS_BITS-1:0] pair_offset;
  logic [70:0] pair;
  logic [5:0] pair_left;  // bits by which it is still to be shifted, by 8 or less a clock
  logic second;  // pair begins with the second entry
  wire [31:0] entry_mask = ~(32'hFFFF_FFFF << offset_bits);
  wire [31:0] entry_field = pair[31:0] & entry_mask;
  logic [31:0] begin_offset, end_offset;
  logic [49:0] end_at;
  logic [ADDRESS_BITS-1:0] begin_at;
  logic none;

  assign idle = state == IDLE;
  wire record_usable = record_there && record_error == 0;

  // What the state needs to read.
  always_comb begin
    read_start = 1'b0;
    read_address = stream.tile_address + pair_offset;
    unique case (state)
      CHOOSE: begin
        read_start = read_idle && !group_hit && !root_hit;
        read_address = stream.root_address + ({{(ADDRESS_BITS - GROUP_BITS) {1'b0}}, group} >> 6 << 4);
      end
      RECORD: begin
        read_start = read_idle && place_set && !number_outside;
        read_address = stream.group_address + {number[NUMBER_BITS-1:0], 4'd0};
      end
      TABLE: read_start = read_idle && record_usable && place_set && !table_outside;
      default: ;
    endcase
  end

  wire looks_up = state == LOOK_UP;
  wire keeps_root = state == ROOT && read_done;
  wire keeps_record = state == TABLE;
  hmlfc_ram #(
      .WIDTH(ROOT_BITS),
      .DEPTH(ROOTS)
  ) root_entries (
      .clk,
      .write(keeps_root),
      .write_address(root_slot),
      .write_data({root_tag, bytes}),
      .read(looks_up),
      .read_address(root_slot),
      .read_data(kept_root)
  );
  hmlfc_ram #(
      .WIDTH(RECORD_BITS),
      .DEPTH(GROUPS)
  ) group_records (
      .clk,
      .write(keeps_record),
      .write_address(slot),
      .write_data({group[GROUP_BITS-1:SLOT_BITS], record_there, record_error, offset_bits, table_offset, tile_mask}),
      .read(looks_up),
      .read_address(slot),
      .read_data(kept)
  );

  always_ff @(posedge clk) begin
    done <= 1'b0;
    step <= step + 1'b1;
    unique case (state)
      IDLE:
      if (start) begin
        group <= tile[TILE_BITS-1:6];
        lane <= tile[5:0];
        error <= '0;
        empty <= 1'b0;
        state <= LOOK_UP;
      end
      LOOK_UP: begin
        kept_valid <= group_valid[slot];
        kept_root_valid <= root_valid[root_slot];
        state <= CHOOSE;
      end
      CHOOSE: begin
        {record_there, record_error, offset_bits, table_offset, tile_mask} <= kept[RECORD_BITS-TAG_BITS-1:0];
        {root_first, root_mask} <= kept_root[127:0];
        step <= '0;
        if (group_hit) state <= ENTRIES;
        else if (root_hit) state <= RANK;
        else if (read_start) state <= ROOT;
      end
      ROOT:
      if (read_done) begin
        root_valid[root_slot] <= !read_error;
        {root_first, root_mask} <= bytes;
        step <= '0;
        state <= RANK;
        if (read_error) begin
          error <= 6'(HMLFC_ERROR_BUS_ERROR);
          done <= 1'b1;
          state <= IDLE;
        end
      end
      RANK: begin
        if (step == 3'd3) number <= (NUMBER_BITS + 1)'(root_first[NUMBER_BITS-1:0]) + (NUMBER_BITS + 1)'(count);
        if (step == 3'd4) begin
          number_outside <= root_first[63:NUMBER_BITS] != 0 || number >= (NUMBER_BITS + 1)'(stream.group_records);
          state <= RECORD;
        end
      end
      RECORD: begin
        record_there <= place_set;
        record_error <= number_outside ? 6'(HMLFC_ERROR_BAD_ROOT_ENTRY) : 6'd0;
        if (read_start) state <= GROUP;
        else if (read_idle) state <= TABLE;
      end
      GROUP:
      if (read_done) begin
        tile_mask <= bytes[63:0];
        table_offset <= bytes[111:64];
        offset_bits <= bytes[117:112];
        if (bytes[127:120] != 0 || bytes[119:112] == 0 || bytes[119:112] > 8'd32) begin
          record_error <= 6'(HMLFC_ERROR_BAD_GROUP_RECORD);
        end
        step <= '0;
        state <= ENTRIES;
        if (read_error) begin
          error <= 6'(HMLFC_ERROR_BUS_ERROR);
          done <= 1'b1;
          state <= IDLE;
        end
      end
      ENTRIES: begin  // first all entries, a clock later those below the tile's
        product <= (step == 3'd3 ? 13'(count) : 13'(first_entry)) * 13'(offset_bits);
        unique case (step)
          3'd4: begin
            table_bytes <= 9'((product + 13'd7) >> 3);
            first <= count == 7'd0;
          end
          3'd5: begin
            records_offset <= 49'(table_offset) + 49'(table_bytes);
            pair_offset <= ADDRESS_BITS'(table_offset) + ADDRESS_BITS'(product[12:3]);
            pair_shift <= product[2:0];
          end
          3'd6: begin
            table_outside <= records_offset > 49'(stream.tile_bytes);
            state <= TABLE;
          end
          default: ;
        endcase
        if (!record_usable) state <= TABLE;
      end
      TABLE: begin
        group_valid[slot] <= 1'b1;
        if (read_start) begin
          state <= EXTENT;
        end else if (read_idle) begin
          if (record_there && record_error != 0) error <= record_error;
          else if (record_there && place_set) error <= 6'(HMLFC_ERROR_BAD_GROUP_RECORD);
          else empty <= 1'b1;
          done <= 1'b1;
          state <= IDLE;
        end
      end
      EXTENT:
      if (read_done) begin
        pair <= bytes[70:0];
        pair_left <= 6'(pair_shift);
        second <= 1'b0;
        if (read_error) error <= 6'(HMLFC_ERROR_BUS_ERROR);
        state <= PAIR;
      end
      PAIR: begin
        pair <= pair_left[5:3] != 0 ? pair >> 8 : pair >> pair_left[2:0];
        pair_left <= pair_left[5:3] != 0 ? pair_left - 6'd8 : '0;
        if (pair_left == 0) begin
          second <= 1'b1;
          pair_left <= offset_bits;
          begin_offset <= second ? end_offset : 32'd0;
          end_offset <= entry_field;
          if (first || second) state <= BOUNDS;
        end
      end
      BOUNDS: begin
        none <= end_offset <= begin_offset;
        end_at <= 50'(records_offset) + 50'(end_offset);
        begin_at <= ADDRESS_BITS'(records_offset) + ADDRESS_BITS'(begin_offset);
        record_bytes <= end_offset - begin_offset;
        state <= FINISH;
      end
      default: begin  // FINISH
        if (error == 0 && (none || end_at > 50'(stream.tile_bytes))) error <= 6'(HMLFC_ERROR_BAD_TILE_OFFSET);
        record_address <= stream.tile_address + begin_at;
        done <= 1'b1;
        state <= IDLE;
      end
    endcase
    if (!rst_n) begin
      state <= IDLE;
      done <= 1'b0;
    end
    if (!rst_n || flush) begin
      root_valid <= '0;
      group_valid <= '0;
    end
  end

endmodule

`default_nettype wire
