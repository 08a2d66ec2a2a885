"""Large streams without large data: a hole in the TILE section, which no record lies in.

The file stays intact to the last checksum: offsets of the index (IDX-5), the section's size and all
CRCs (FIL-3 to FIL-5) are those of the file with its hole.
"""

import struct

from process import BenchError

SECTIONS = 4
ENTRY = struct.Struct("<IIQQ")  # type, crc, offset, size (FIL-3)
RECORD = struct.Struct("<QQ")  # tile_mask, place (IDX-5)
DATA_BITS = 48
POLYNOMIAL = 0x82F63B78  # of CRC-32C, reflected
START = 0xFFFFFFFF


def _table():
    table = []
    for value in range(256):
        for _ in range(8):
            value = value >> 1 ^ (POLYNOMIAL if value & 1 else 0)
        table.append(value)
    return table


TABLE = _table()


def advance(register, data):
    """The register of CRC-32C after bytes."""
    for byte in data:
        register = register >> 8 ^ TABLE[(register ^ byte) & 0xFF]
    return register


def advance_zeros(register, count):
    """The register after `count` zero bytes: the linear map of one, by repeated squaring."""
    columns = [advance(1 << bit, b"\0") for bit in range(32)]
    while count:
        if count & 1:
            register = _apply(columns, register)
        columns = [_apply(columns, column) for column in columns]
        count >>= 1
    return register


def crc32c(data):
    return advance(START, data) ^ START


def _apply(columns, register):
    result = 0
    for bit, column in enumerate(columns):
        if register >> bit & 1:
            result ^= column
    return result


def sections(header):
    """(type, crc, offset, size) of TOP, ROOT, GROUP and TILE."""
    at = len(header) - 4 - SECTIONS * ENTRY.size
    return [ENTRY.unpack_from(header, at + k * ENTRY.size) for k in range(SECTIONS)]


def read_header(file):
    """The header of an open stream."""
    head = file.read(12)
    header_bytes = struct.unpack_from("<H", head, 10)[0]
    return head + file.read(header_bytes - 12)


def write_with_hole(source, target, hole):
    """Writes the stream `source` to `target` with `hole` more bytes in its TILE section, after a
    quarter of its groups, as a hole of the file system. It is the same light field."""
    stream = source.read_bytes()
    with open(source, "rb") as file:
        header = bytearray(read_header(file))
    entries = sections(header)
    _, _, group_at, group_size = entries[2]
    tile_type, _, tile_at, tile_size = entries[3]
    records = [RECORD.unpack_from(stream, at) for at in range(group_at, group_at + group_size, 16)]
    data = sorted(_data(place) for mask, place in records if mask)
    if not data:
        raise BenchError(f"{source}: no tile to move")
    cut = data[len(data) // 4]
    group = b"".join(
        RECORD.pack(mask, place + hole if _data(place) >= cut else place) for mask, place in records
    )
    tile = stream[tile_at:tile_at + tile_size]
    register = advance_zeros(advance(START, tile[:cut]), hole)
    crc = advance(register, tile[cut:]) ^ START
    table = len(header) - 4 - SECTIONS * ENTRY.size
    ENTRY.pack_into(header, table + 2 * ENTRY.size, 3, crc32c(group), group_at, group_size)
    ENTRY.pack_into(header, table + 3 * ENTRY.size, tile_type, crc, tile_at, tile_size + hole)
    struct.pack_into("<I", header, len(header) - 4, crc32c(header[:-4]))
    with open(target, "wb") as file:
        file.write(header + stream[len(header):group_at] + group + tile[:cut])
        file.seek(hole, 1)
        file.write(tile[cut:])
        file.truncate(tile_at + tile_size + hole)


def _data(place):
    return place & (1 << DATA_BITS) - 1
