"""From a tile number to the tile's record (IDX-3 to IDX-7)."""

from functools import lru_cache

from bit_string import BitString
from header import number
from integers import ceil_div, popcount, rank
from stream_error import require


@lru_cache
def find_record(stream, tile):
    """The record of tile number `tile` as a bit string, or None for an empty tile: its blocks are zero (IDX-7)."""
    group, lane = divmod(tile, 64)
    entry = 16 * (group // 64)
    mask, first = number(stream.root, entry, 8), number(stream.root, entry + 8, 8)
    if mask >> group % 64 & 1 == 0:
        return None
    at = 16 * (first + rank(mask, group % 64))
    require(at + 16 <= len(stream.group), "bad_root_entry")
    tile_mask, place = number(stream.group, at, 8), number(stream.group, at + 8, 8)
    data, offset_bits = place % 2**48, place >> 48 & 0xFF
    require(1 <= offset_bits <= 32 and place >> 56 == 0, "bad_group_record")
    if tile_mask >> lane & 1 == 0:
        return None
    table_bytes = ceil_div(popcount(tile_mask) * offset_bits, 8)
    records = data + table_bytes
    require(records <= len(stream.tile), "bad_group_record")
    table = BitString(stream.tile[data:records])
    j = rank(tile_mask, lane)
    begin = table.field((j - 1) * offset_bits, offset_bits) if j > 0 else 0
    end = table.field(j * offset_bits, offset_bits)
    require(begin < end and records + end <= len(stream.tile), "bad_tile_offset")
    return BitString(stream.tile[records + begin : records + end])
