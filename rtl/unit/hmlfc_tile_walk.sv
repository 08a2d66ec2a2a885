// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Walks the index from a tile's number to its record (IDX-3 to IDX-7): three dependent reads at most (BND-1).
//
//   look up -> [WALKS] -> root entry -> [WALKS] -> group record -> [WALKS] -> end table -> out
//
// Walks go in order, and many are on the way: each step asks for what the next one needs, and the walk waits for it in
// the queue between them. `out_error` is the number of an error of annex A; without one, `out_empty` says that the tile
// has no record, else the record's `out_bytes` bytes begin at byte address `out_address`.
//
// ROOTS root entries and the records of GROUPS tile groups are kept, so that tiles of a tile group seen before cost one
// read, of the end table. What is kept is decided at the look-up, where tags are written, and put in its place at its
// step; as both see the walks in the same order, a place holds what its tag said. `flush` forgets all tags, and so does
// a bus error; that takes as many clocks as there are places, in which no walk begins.
module hmlfc_tile_walk #(
    parameter int DATA_BITS = 128,
    parameter int INFO_BITS = 8,  // what goes along
    parameter int WALKS = 16,  // that wait for a step, at most
    parameter int GROUPS = 256,  // a power of two
    parameter int ROOTS = 16,  // a power of two, at least GROUPS / 64
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int TILE_BITS = hmlfc_pkg::TILE_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic in_valid,
    output logic in_ready,
    input logic [TILE_BITS-1:0] in_tile,
    input logic [INFO_BITS-1:0] in_info,

    output logic out_valid,
    input logic out_ready,
    output logic [INFO_BITS-1:0] out_info,
    output logic [5:0] out_error,
    output logic out_empty,
    output logic [ADDRESS_BITS-1:0] out_address,
    output logic [31:0] out_bytes,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  localparam int GROUP_BITS = TILE_BITS - 6;
  localparam int SLOT_BITS = $clog2(GROUPS);
  localparam int TAG_BITS = GROUP_BITS - SLOT_BITS;
  localparam int ROOT_SLOT_BITS = $clog2(ROOTS);
  localparam int ROOT_TAG_BITS = GROUP_BITS - 6 - ROOT_SLOT_BITS;
  localparam int PLACE_BITS = 6 + 6 + ROOT_SLOT_BITS;  // of a tile number, that are needed after the look-up
  localparam int NUMBER_BITS = ADDRESS_BITS - 4;  // of group records
  localparam logic [5:0] BUS_ERROR = 6'(HMLFC_ERROR_BUS_ERROR);

  logic [2:0] ask, ask_ready, come, take, read_error;
  logic [3*ADDRESS_BITS-1:0] ask_address;
  logic [3*128-1:0] read_bytes;
  hmlfc_index_reads #(.DATA_BITS(DATA_BITS), .DEPTH(WALKS)) reads (
      .clk, .rst_n, .ask, .ask_ready, .address(ask_address), .valid(come), .take, .bytes(read_bytes),
      .error(read_error), .request, .response, .data
  );

  // ---- Look-up, two clocks a walk: tags are read, compared and written.
  wire [GROUP_BITS-1:0] in_group = in_tile[TILE_BITS-1:6];
  wire [SLOT_BITS-1:0] in_slot = in_group[SLOT_BITS-1:0];
  wire [ROOT_SLOT_BITS-1:0] in_root_slot = in_group[6+:ROOT_SLOT_BITS];
  wire [TAG_BITS-1:0] in_tag = in_group[GROUP_BITS-1:SLOT_BITS];
  wire [ROOT_TAG_BITS-1:0] in_root_tag = in_group[GROUP_BITS-1-:ROOT_TAG_BITS];
  logic looking, forget, forgets, root_ready;
  logic [SLOT_BITS-1:0] forgotten;
  logic kept_valid, kept_root_valid;
  logic [TAG_BITS-1:0] kept_tag;
  logic [ROOT_TAG_BITS-1:0] kept_root_tag;
  wire group_hit = kept_valid && kept_tag == in_tag;
  wire root_hit = group_hit || (kept_root_valid && kept_root_tag == in_root_tag);
  assign in_ready = looking && root_ready && (root_hit || ask_ready[0]);
  assign ask[0] = looking && root_ready && !root_hit;
  assign ask_address[0+:ADDRESS_BITS] = stream.root_address + (ADDRESS_BITS'(in_group[GROUP_BITS-1:6]) << 4);
  always_ff @(posedge clk) begin
    looking <= rst_n && in_valid && !forgets && !in_ready;
    forgets <= !rst_n || flush || forget || (forgets && forgotten != SLOT_BITS'(GROUPS - 1));
    forgotten <= !rst_n || flush || forget ? '0 : forgotten + 1'b1;
  end
  hmlfc_ram #(.WIDTH(1 + TAG_BITS), .DEPTH(GROUPS)) group_tags (
      .clk, .write(forgets || in_ready), .write_address(forgets ? forgotten : in_slot), .write_data({!forgets, in_tag}),
      .read(!looking), .read_address(in_slot), .read_data({kept_valid, kept_tag})
  );
  hmlfc_ram #(.WIDTH(1 + ROOT_TAG_BITS), .DEPTH(ROOTS)) root_tags (
      .clk, .write(forgets || (in_ready && !root_hit)),
      .write_address(forgets ? forgotten[ROOT_SLOT_BITS-1:0] : in_root_slot), .write_data({!forgets, in_root_tag}),
      .read(!looking), .read_address(in_root_slot), .read_data({kept_root_valid, kept_root_tag})
  );

  // ---- Root entry: one clock where the group's record is kept, else seven.
  logic root_valid, root_take, root_group_hit, root_read;
  logic [PLACE_BITS-1:0] root_tile;
  logic [INFO_BITS-1:0] root_info;
  wire [ROOT_SLOT_BITS-1:0] root_slot = root_tile[12+:ROOT_SLOT_BITS];
  hmlfc_fifo #(.WIDTH(INFO_BITS + PLACE_BITS + 2), .DEPTH(WALKS)) to_root (
      .clk, .rst_n, .in_valid(in_ready), .in_ready(root_ready),
      .in_data({in_info, in_tile[PLACE_BITS-1:0], group_hit, !root_hit}), .out_valid(root_valid), .out_ready(root_take),
      .out_data({root_info, root_tile, root_group_hit, root_read}), .count()
  );
  logic [2:0] root_step;
  logic [128:0] kept_root;  // {a bus error, number of the first record, mask}
  wire [128:0] root = root_read ? {read_error[0], read_bytes[0+:128]} : kept_root;
  wire root_comes = root_valid && !root_group_hit && (!root_read || come[0]);
  wire keeps_root = root_step == 3'd1 && root_read;
  hmlfc_ram #(.WIDTH(129), .DEPTH(ROOTS)) root_entries (
      .clk, .write(keeps_root), .write_address(root_slot), .write_data(root), .read(root_step == 3'd0),
      .read_address(root_slot), .read_data(kept_root)
  );
  logic [6:0] root_rank;
  hmlfc_mask_count root_count (
      .clk, .advance(1'b1), .mask(root[63:0]), .all(1'b0), .place(root_tile[11:6]), .count(root_rank)
  );
  // IDX-4: the number of the tile group's record. The first one may be any 64-bit number; above NUMBER_BITS it is
  // outside.
  logic [NUMBER_BITS:0] number;
  logic there, outside, group_ready;
  wire needs_group = there && !outside && !root[128];
  wire root_ends = root_step == 3'd6 && group_ready && (!needs_group || ask_ready[1]);
  assign ask[1] = root_step == 3'd6 && group_ready && needs_group;
  assign ask_address[ADDRESS_BITS+:ADDRESS_BITS] = stream.group_address + {number[NUMBER_BITS-1:0], 4'd0};
  assign root_take = root_ends || (root_valid && root_group_hit && group_ready);
  assign take[0] = root_ends && root_read;
  always_ff @(posedge clk) begin
    there <= root[{2'd0, root_tile[11:6]}];
    number <= (NUMBER_BITS + 1)'(root[64+:NUMBER_BITS]) + (NUMBER_BITS + 1)'(root_rank);
    outside <= root[127:64+NUMBER_BITS] != 0 || number >= (NUMBER_BITS + 1)'(stream.group_records);
    if (root_step == 3'd0 ? root_comes : root_step != 3'd6) root_step <= root_step + 1'b1;
    if (root_ends || !rst_n) root_step <= '0;
  end

  // ---- Group record: a pipeline. 0: it has come, and the one in its place is read.
  logic group_valid, group_take, was_kept, group_asked, group_outside, root_failed;
  logic [SLOT_BITS+5:0] group_tile;
  logic [INFO_BITS-1:0] group_info;
  hmlfc_fifo #(.WIDTH(INFO_BITS + 6 + SLOT_BITS + 4), .DEPTH(WALKS)) to_group (
      .clk, .rst_n, .in_valid(root_take), .in_ready(group_ready),
      .in_data({root_info, root_tile[SLOT_BITS+5:0], root_group_hit, ask[1], there && outside, root[128]}),
      .out_valid(group_valid), .out_ready(group_take),
      .out_data({group_info, group_tile, was_kept, group_asked, group_outside, root_failed}), .count()
  );
  wire [SLOT_BITS-1:0] group_slot = group_tile[6+:SLOT_BITS];
  localparam int STAGES = 8;
  logic [STAGES:1] valid;
  logic table_ready;
  wire needs_table;
  wire advance = !valid[STAGES] || (table_ready && (!needs_table || ask_ready[2]));
  // What stage 1 writes is not read in the same clock.
  logic keeps_group, group_failed;
  logic [SLOT_BITS-1:0] slot_1;
  wire enter = group_valid && (!group_asked || come[1]) && !(keeps_group && group_slot == slot_1);
  assign group_take = advance && enter;
  assign take[1] = group_take && group_asked;

  // 1: {there is one, error, offset_bits, data, tile_mask}.
  localparam int RECORD_BITS = 1 + 6 + 6 + 48 + 64;
  logic was_kept_1, asked_1, outside_1, root_failed_1;
  logic [5:0] lane_1;
  logic [128:0] bytes_1;
  logic [RECORD_BITS-1:0] kept_record, new_record;
  wire bad_record = bytes_1[127:120] != 0 || bytes_1[119:112] == 0 || bytes_1[119:112] > 8'd32;
  assign group_failed = root_failed_1 || (asked_1 && bytes_1[128]);
  wire [5:0] new_error = group_failed ? BUS_ERROR : outside_1 ? 6'(HMLFC_ERROR_BAD_ROOT_ENTRY) :
      asked_1 && bad_record ? 6'(HMLFC_ERROR_BAD_GROUP_RECORD) : 6'd0;
  assign new_record = {asked_1 || outside_1 || root_failed_1, new_error, bytes_1[117:112], bytes_1[111:0]};
  assign keeps_group = valid[1] && !was_kept_1 && advance;
  assign forget = keeps_group && group_failed;
  hmlfc_ram #(.WIDTH(RECORD_BITS), .DEPTH(GROUPS)) group_records (
      .clk, .write(keeps_group), .write_address(slot_1), .write_data(new_record), .read(advance),
      .read_address(group_slot), .read_data(kept_record)
  );

  // 2: the record. 3 to 5: how many entries its end table has, and how many are below the tile's.
  logic [RECORD_BITS-1:0] record_2;
  logic [5:0] lane_2;
  logic [6:0] entries, below;
  hmlfc_mask_count count_all (
      .clk, .advance, .mask(record_2[63:0]), .all(1'b1), .place(lane_2), .count(entries)
  );
  hmlfc_mask_count count_below (
      .clk, .advance, .mask(record_2[63:0]), .all(1'b0), .place(lane_2), .count(below)
  );
  // What goes along from stage 3 on: {info, there is one, the tile has an entry, error, offset_bits, data}.
  localparam int CARRY_BITS = INFO_BITS + 2 + 6 + 6 + 48;
  logic [2*INFO_BITS-1:0] infos;
  logic [(STAGES-2)*CARRY_BITS-1:0] carries;
  wire [CARRY_BITS-INFO_BITS-1:0] carry_2 =
      {record_2[RECORD_BITS-1], record_2[{1'b0, lane_2}], record_2[RECORD_BITS-2:64]};

  // 6: sizes of the table and of what of it lies before the entry before the tile's. 7: where the records begin, and
  // the two entries that bound the tile's, or the one, for the first. 8: whether the table lies in the section.
  wire [5:0] offset_bits_5 = carries[2*CARRY_BITS+48+:6];
  wire [47:0] table_6 = carries[3*CARRY_BITS+:48];
  logic [12:0] table_bits_6, before_6;
  logic first_6, first_7, first_8;
  logic [48:0] records_7, records_8;
  logic [ADDRESS_BITS-1:0] pair_7, pair_8;
  logic [2:0] shift_7, shift_8;
  logic table_outside;
  logic [1:0] flags_8;
  logic [5:0] error_8, offset_bits_8;
  always_ff @(posedge clk) begin
    if (advance) begin
      valid <= {valid[STAGES-1:1], enter};
      {was_kept_1, asked_1, outside_1, root_failed_1} <= {was_kept, group_asked, group_outside, root_failed};
      slot_1 <= group_slot;
      {lane_2, lane_1} <= {lane_1, group_tile[5:0]};
      bytes_1 <= {read_error[1], read_bytes[128+:128]};
      record_2 <= was_kept_1 ? kept_record : new_record;
      infos <= {infos[INFO_BITS-1:0], group_info};
      carries <= {carries[(STAGES-3)*CARRY_BITS-1:0], infos[INFO_BITS+:INFO_BITS], carry_2};
      table_bits_6 <= 13'(entries) * 13'(offset_bits_5) + 13'd7;
      before_6 <= (below == 7'd0 ? 13'd0 : 13'(below) - 13'd1) * 13'(offset_bits_5);
      first_6 <= below == 7'd0;
      records_7 <= 49'(table_6) + 49'(table_bits_6[12:3]);
      pair_7 <= ADDRESS_BITS'(table_6) + ADDRESS_BITS'(before_6[12:3]);
      {shift_7, first_7} <= {before_6[2:0], first_6};
      {records_8, shift_8, first_8} <= {records_7, shift_7, first_7};
      pair_8 <= stream.tile_address + pair_7;
      table_outside <= records_7 > 49'(stream.tile_bytes);
    end
    if (!rst_n) valid <= '0;
  end
  assign {flags_8, error_8, offset_bits_8} = carries[(STAGES-3)*CARRY_BITS+48+:14];
  wire [INFO_BITS-1:0] info_8 = carries[(STAGES-2)*CARRY_BITS-1-:INFO_BITS];
  assign needs_table = flags_8 == 2'b11 && error_8 == 0 && !table_outside;
  wire [5:0] group_error = !flags_8[1] ? 6'd0 : error_8 != 0 ? error_8 :
      flags_8[0] && table_outside ? 6'(HMLFC_ERROR_BAD_GROUP_RECORD) : 6'd0;
  assign ask[2] = valid[STAGES] && table_ready && needs_table;
  assign ask_address[2*ADDRESS_BITS+:ADDRESS_BITS] = pair_8;

  // ---- End table: a pipeline of five clocks. 1: bits from the first of both entries on.
  logic bound_valid, bound_asked, bound_first;
  logic [5:1] bounds;  // valid
  wire bound_advance = !bounds[5] || out_ready;
  wire bound_enter = bound_valid && (!bound_asked || come[2]);
  assign take[2] = bound_advance && bound_enter && bound_asked;
  logic [INFO_BITS-1:0] bound_info;
  logic [5:0] bound_error, bound_offset_bits;
  logic [48:0] bound_records;
  logic [2:0] bound_shift;
  hmlfc_fifo #(.WIDTH(INFO_BITS + 6 + 1 + 6 + 49 + 3 + 1), .DEPTH(WALKS)) to_table (
      .clk, .rst_n, .in_valid(valid[STAGES] && (!needs_table || ask_ready[2])), .in_ready(table_ready),
      .in_data({info_8, group_error, needs_table, offset_bits_8, records_8, shift_8, first_8}), .out_valid(bound_valid),
      .out_ready(bound_advance && bound_enter),
      .out_data({bound_info, bound_error, bound_asked, bound_offset_bits, bound_records, bound_shift, bound_first}),
      .count()
  );
  localparam int BOUND_BITS = INFO_BITS + 6 + 1 + 49;
  logic [3*BOUND_BITS-1:0] bound_carries;
  logic [70:0] pair_1;
  logic [5:0] width_1;
  logic first_1, first_2, none;
  logic [38:0] pair_2;
  logic [2:0] left_2;
  logic [31:0] field_2, mask_2, begin_3, end_3;
  logic [49:0] end_at;
  wire [31:0] mask_1 = ~(32'hFFFF_FFFF << width_1);
  wire [48:0] records_3 = bound_carries[2*BOUND_BITS+:49];
  wire [5:0] table_error = bound_asked && read_error[2] ? BUS_ERROR : bound_error;
  logic has_record_4;
  logic [5:0] error_4;
  logic [INFO_BITS-1:0] info_4;
  logic [ADDRESS_BITS-1:0] address_4;
  logic [31:0] bytes_4;
  always_ff @(posedge clk) begin
    if (bound_advance) begin
      bounds <= {bounds[4:1], bound_enter};
      bound_carries <= {bound_carries[2*BOUND_BITS-1:0], bound_info, table_error, bound_asked, bound_records};
      pair_1 <= 71'(read_bytes[2*128+:78] >> bound_shift);
      {width_1, first_1} <= {bound_offset_bits, bound_first};
      // 2, 3: the entries.
      field_2 <= pair_1[31:0] & mask_1;
      mask_2 <= mask_1;
      pair_2 <= 39'(pair_1 >> {width_1[5:3], 3'd0});
      {left_2, first_2} <= {width_1[2:0], first_1};
      begin_3 <= first_2 ? 32'd0 : field_2;
      end_3 <= first_2 ? field_2 : 32'(pair_2 >> left_2) & mask_2;
      // 4: the record.
      none <= end_3 <= begin_3;
      end_at <= 50'(records_3) + 50'(end_3);
      address_4 <= stream.tile_address + ADDRESS_BITS'(records_3) + ADDRESS_BITS'(begin_3);
      bytes_4 <= end_3 - begin_3;
      {info_4, error_4, has_record_4} <= bound_carries[3*BOUND_BITS-1-:INFO_BITS+7];
      // 5: whether it lies in the section.
      {out_info, out_address, out_bytes} <= {info_4, address_4, bytes_4};
      out_empty <= error_4 == 0 && !has_record_4;
      out_error <= error_4 != 0 || !has_record_4 ? error_4 :
          none || end_at > 50'(stream.tile_bytes) ? 6'(HMLFC_ERROR_BAD_TILE_OFFSET) : 6'd0;
    end
    if (!rst_n) bounds <= '0;
  end
  assign out_valid = bounds[5];

endmodule

`default_nettype wire
