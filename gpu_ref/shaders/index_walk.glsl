// From a tile to its record in four dependent reads (section 4).

const uint kLaneLog2 = 6u;    // 64 lanes a mask (IDX-3)
const uint kEntryWords = 4u;  // root entries and records of tile groups: 16 bytes (IDX-4, IDX-5)

/// Entry j of the end table that begins at byte `table` of the stream (IDX-6).
uint end_entry(uvec2 table, uint j, uint offset_bits) {
  const uint at = (table.x & 3u) * 8u + j * offset_bits;
  return stream_bits(u64_shift_right(table, 2u).x + (at >> 5), at & 31u, offset_bits);
}

/// The bytes of record number `j` of a tile group (IDX-6). `data` is an offset into the TILE section.
Record find_extent(uvec2 data, uint count, uint j, uint offset_bits) {
  const uvec2 tile_bytes = uvec2(arguments.shape.tile_bytes_low, arguments.shape.tile_bytes_high);
  const uvec2 table_bytes = uvec2((count * offset_bits + 7u) >> 3, 0u);
  if (u64_less(tile_bytes, data) || u64_less(u64_sub(tile_bytes, data), table_bytes)) {
    return no_record(ERROR_BAD_GROUP_RECORD);
  }
  const uvec2 section = u64_product(arguments.shape.tile_word, 4u);
  const uvec2 table = u64_add(section, data);
  const uint begin = j == 0u ? 0u : end_entry(table, j - 1u, offset_bits);
  const uint end = end_entry(table, j, offset_bits);
  const uvec2 records = u64_add(data, table_bytes);
  if (end <= begin || u64_less(tile_bytes, u64_add(records, uvec2(end, 0u)))) {
    return no_record(ERROR_BAD_TILE_OFFSET);
  }
  const uvec2 first = u64_add(u64_add(section, records), uvec2(begin, 0u));
  return Record(ERROR_OK, false, u64_shift_right(first, 2u).x, (first.x & 3u) * 8u,
                min(end - begin, 1u << 20) * 8u);
}

/// The record of tile number `tile` (IDX-2), below the number of tiles.
Record find_tile(uvec2 tile) {
  const uint lane = tile.x & 63u;
  const uint tile_group_lane = (tile.x >> kLaneLog2) & 63u;
  // ROOT has an entry for every 64 tile groups (its size was checked) and lies in 2^32 words.
  const uint root = u64_shift_right(tile, 2u * kLaneLog2).x * kEntryWords;
  const uvec2 mask = uvec2(stream_word(root), stream_word(root + 1u));
  if (!has_bit(mask, tile_group_lane)) return no_record(ERROR_OK);  // IDX-4
  const uvec2 first = uvec2(stream_word(root + 2u), stream_word(root + 3u));
  const uint below = rank(mask, tile_group_lane);
  const uint records = arguments.shape.group_records;
  if (below >= records || first.y != 0u || first.x >= records - below) {
    return no_record(ERROR_BAD_ROOT_ENTRY);  // IDX-5
  }
  const uint at = arguments.shape.group_word + (first.x + below) * kEntryWords;
  const uvec2 tile_mask = uvec2(stream_word(at), stream_word(at + 1u));
  const uint place = stream_word(at + 3u);
  const uvec2 data = uvec2(stream_word(at + 2u), place & 0xFFFFu);
  const uint offset_bits = (place >> 16) & 0xFFu;
  if (offset_bits < 1u || offset_bits > 32u || (place >> 24) != 0u) {
    return no_record(ERROR_BAD_GROUP_RECORD);
  }
  if (!has_bit(tile_mask, lane)) return no_record(ERROR_OK);
  return find_extent(data, popcount(tile_mask), rank(tile_mask, lane), offset_bits);
}
