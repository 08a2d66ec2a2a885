"""Large streams without large data: a hole in the TILE section, which no record lies in.

Offsets of the index (IDX-5), sizes of sections and the checksums of header and GROUP are those of the file with its
hole; that of TILE, which access to single blocks does not read, is not.
"""

import struct

from process import BenchError

SECTIONS = 4
ENTRY = struct.Struct("<IIQQ")  # type, crc, offset, size (FIL-3)
RECORD = struct.Struct("<QQ")  # tile_mask, place (IDX-5)
DATA = (1 << 48) - 1  # of a place: where the tile's record lies
POLYNOMIAL = 0x82F63B78  # of CRC-32C, reflected


def crc32c(data):
    register = 0xFFFFFFFF
    for byte in data:
        register ^= byte
        for _ in range(8):
            register = register >> 1 ^ (POLYNOMIAL if register & 1 else 0)
    return register ^ 0xFFFFFFFF


def sections(stream):
    """(type, crc, offset, size) of TOP, ROOT, GROUP and TILE. stream: its first bytes, with the whole header."""
    at = struct.unpack_from("<H", stream, 10)[0] - 4 - SECTIONS * ENTRY.size
    return [ENTRY.unpack_from(stream, at + k * ENTRY.size) for k in range(SECTIONS)]


def write_with_hole(source, target, hole):
    """Writes the stream `source` to `target` with `hole` more bytes in its TILE section, after a
    quarter of its groups, as a hole of the file system. It is the same light field."""
    stream = bytearray(source.read_bytes())
    _, _, group_at, group_size = sections(stream)[2]
    tile_type, tile_crc, tile_at, tile_size = sections(stream)[3]
    records = [RECORD.unpack_from(stream, at) for at in range(group_at, group_at + group_size, RECORD.size)]
    places = sorted(place & DATA for mask, place in records if mask)
    if not places:
        raise BenchError(f"{source}: no tile to move")
    cut = places[len(places) // 4]
    group = b"".join(RECORD.pack(mask, place + hole * (place & DATA >= cut)) for mask, place in records)
    header_bytes = struct.unpack_from("<H", stream, 10)[0]
    table = header_bytes - 4 - SECTIONS * ENTRY.size
    stream[group_at : group_at + group_size] = group
    ENTRY.pack_into(stream, table + 2 * ENTRY.size, 3, crc32c(group), group_at, group_size)
    ENTRY.pack_into(stream, table + 3 * ENTRY.size, tile_type, tile_crc, tile_at, tile_size + hole)
    struct.pack_into("<I", stream, header_bytes - 4, crc32c(stream[: header_bytes - 4]))
    with open(target, "wb") as file:
        file.write(stream[: tile_at + cut])
        file.seek(hole, 1)
        file.write(stream[tile_at + cut :])
        file.truncate(len(stream) + hole)
