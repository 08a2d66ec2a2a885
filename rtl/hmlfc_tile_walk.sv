`include "hmlfc_tables.svh"

// Walks the index from a tile's number to its record (IDX-3 to IDX-7): three dependent reads at most (BND-1).
//
// `start` with `tile` begins a walk when `idle`. `done` is high for one clock when the result holds:
// `error` is the number of an error of annex A; without one, `empty` says that the tile has no record,
// else the record's `record_bytes` bytes begin at byte address `record_address`. The result keeps until
// the next start.
//
// The last root entry and the records of GROUPS tile groups are kept, so that tiles of a tile group seen
// before cost one read, of the end table; `flush` forgets them. What a bus error brought is not kept.
module hmlfc_tile_walk #(
    parameter int DATA_BITS = 128,
    parameter int GROUPS = 8,  // tile groups, a power of two
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

    output logic request_valid,
    input logic request_ready,
    output logic [ADDRESS_BITS-1:0] request_address,
    output logic [9:0] request_beats,
    input logic data_valid,
    input logic [DATA_BITS-1:0] data,
    input logic data_last,
    input logic data_error
);


  localparam int GROUP_BITS = TILE_BITS - 6;
  localparam int SLOT_BITS = $clog2(GROUPS);
  localparam int TAG_BITS = GROUP_BITS - SLOT_BITS;

  // The 1 bits of a mask below bit `lane`: rank of CNV-6 is their number.
  function automatic logic [63:0] below(input logic [63:0] bits, input logic [5:0] lane);
    below = bits & ~(64'hFFFF_FFFF_FFFF_FFFF << lane);
  endfunction

  typedef enum logic [2:0] {
    IDLE,
    LOOK_UP,
    ROOT,
    RECORD,
    GROUP,
    TABLE,
    EXTENT,
    FINISH
  } state_t;
  state_t state;

  logic [GROUP_BITS-1:0] group;
  logic [5:0] lane;
  wire [5:0] group_lane = group[5:0];
  wire [SLOT_BITS-1:0] slot = group[SLOT_BITS-1:0];

  // The root entry of tile groups 64 * root_tag to 64 * root_tag + 63.
  logic root_valid;
  logic [GROUP_BITS-7:0] root_tag;
  logic [63:0] root_mask, root_first;

  // Records of tile groups: {there is one, error, offset_bits, data, tile_mask}.
  localparam int RECORD_BITS = 1 + 6 + 6 + 48 + 64;
  logic [GROUPS-1:0] group_valid;
  logic [GROUPS*TAG_BITS-1:0] group_tags;
  logic [RECORD_BITS-1:0] group_records[GROUPS];

  logic record_there;
  logic [5:0] record_error;
  logic [5:0] offset_bits;
  logic [47:0] table_offset;
  logic [63:0] tile_mask;

  wire group_hit = group_valid[slot] && group_tags[slot*TAG_BITS+:TAG_BITS] == group[GROUP_BITS-1:SLOT_BITS];
  wire root_hit = root_valid && root_tag == group[GROUP_BITS-1:6];

  logic read_start, read_idle, read_done, read_error;
  logic [ADDRESS_BITS-1:0] read_address;
  logic [127:0] bytes;
  hmlfc_aligned_read #(
      .DATA_BITS(DATA_BITS),
      .ADDRESS_BITS(ADDRESS_BITS)
  ) read (
      .clk,
      .rst_n,
      .start(read_start),
      .address(read_address),
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

  // IDX-4: the number of the tile group's record. `first` may be any 64-bit number.
  wire [64:0] number = {1'b0, root_first} + 65'($countones(below(root_mask, group_lane)));
  wire number_outside = number >= 65'(stream.group_records);

  // IDX-6: the end table and the two entries that bound the record.
  wire [6:0] entries = 7'($countones(tile_mask));
  wire [5:0] entry = 6'($countones(below(tile_mask, lane)));
  wire [13:0] table_bits = 14'(entries) * 14'(offset_bits);
  wire [10:0] table_bytes = 11'((table_bits + 14'd7) >> 3);
  wire table_outside = 49'(table_offset) + 49'(table_bytes) > 49'(stream.tile_bytes);
  wire [5:0] first_entry = entry == 0 ? 6'd0 : entry - 6'd1;
  wire [11:0] first_bit = 12'(first_entry) * 12'(offset_bits);
  wire [63:0] pair = 64'(bytes >> first_bit[2:0]);
  wire [31:0] entry_mask = ~(32'hFFFF_FFFF << offset_bits);
  wire [31:0] entry_low = pair[31:0] & entry_mask;
  wire [31:0] entry_high = 32'(pair >> offset_bits) & entry_mask;
  logic [31:0] begin_offset, end_offset;
  wire [47:0] records_offset = table_offset + 48'(table_bytes);
  wire [48:0] end_at = 49'(records_offset) + 49'(end_offset);

  assign idle = state == IDLE;

  // What the next state needs to read.
  always_comb begin
    read_start = 1'b0;
    read_address = '0;
    if (read_idle) begin
      case (state)
        LOOK_UP:
        if (!group_hit && !root_hit) begin
          read_start = 1'b1;
          read_address = stream.root_address + ({{(ADDRESS_BITS - GROUP_BITS) {1'b0}}, group} >> 6 << 4);
        end
        RECORD:
        if (root_mask[group_lane] && !number_outside) begin
          read_start = 1'b1;
          read_address = stream.group_address + (ADDRESS_BITS'(number) << 4);
        end
        TABLE:
        if (record_there && record_error == 0 && tile_mask[lane] && !table_outside) begin
          read_start = 1'b1;
          read_address = stream.tile_address + ADDRESS_BITS'(table_offset) + ADDRESS_BITS'(first_bit[11:3]);
        end
        default: ;
      endcase
    end
  end

  always_ff @(posedge clk) begin
    done <= 1'b0;
    case (state)
      IDLE:
      if (start) begin
        group <= tile[TILE_BITS-1:6];
        lane <= tile[5:0];
        error <= '0;
        empty <= 1'b0;
        state <= LOOK_UP;
      end
      LOOK_UP: begin
        {record_there, record_error, offset_bits, table_offset, tile_mask} <= group_records[slot];
        if (group_hit) state <= TABLE;
        else if (root_hit) state <= RECORD;
        else if (read_start) state <= ROOT;
      end
      ROOT:
      if (read_done) begin
        root_valid <= !read_error;
        root_tag <= group[GROUP_BITS-1:6];
        {root_first, root_mask} <= bytes;
        state <= RECORD;
        if (read_error) begin
          error <= 6'(HMLFC_ERROR_BUS_ERROR);
          done <= 1'b1;
          state <= IDLE;
        end
      end
      RECORD: begin
        record_there <= root_mask[group_lane];
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
        state <= TABLE;
        if (read_error) begin
          error <= 6'(HMLFC_ERROR_BUS_ERROR);
          done <= 1'b1;
          state <= IDLE;
        end
      end
      TABLE: begin
        group_valid[slot] <= 1'b1;
        group_tags[slot*TAG_BITS+:TAG_BITS] <= group[GROUP_BITS-1:SLOT_BITS];
        group_records[slot] <= {record_there, record_error, offset_bits, table_offset, tile_mask};
        if (read_start) begin
          state <= EXTENT;
        end else if (read_idle) begin
          if (record_there && record_error != 0) error <= record_error;
          else if (record_there && tile_mask[lane]) error <= 6'(HMLFC_ERROR_BAD_GROUP_RECORD);
          else empty <= 1'b1;
          done <= 1'b1;
          state <= IDLE;
        end
      end
      EXTENT:
      if (read_done) begin
        begin_offset <= entry == 0 ? 32'd0 : entry_low;
        end_offset <= entry == 0 ? entry_low : entry_high;
        if (read_error) error <= 6'(HMLFC_ERROR_BUS_ERROR);
        state <= FINISH;
      end
      FINISH: begin
        if (error == 0 && (end_offset <= begin_offset || end_at > 49'(stream.tile_bytes))) begin
          error <= 6'(HMLFC_ERROR_BAD_TILE_OFFSET);
        end
        record_address <= stream.tile_address + ADDRESS_BITS'(records_offset) + ADDRESS_BITS'(begin_offset);
        record_bytes <= end_offset - begin_offset;
        done <= 1'b1;
        state <= IDLE;
      end
    endcase
    if (!rst_n) begin
      state <= IDLE;
      done <= 1'b0;
    end
    if (!rst_n || flush) begin
      root_valid <= 1'b0;
      group_valid <= '0;
    end
  end

endmodule
