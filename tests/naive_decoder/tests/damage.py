"""Damaged copies of a stream, most with right checksums."""

from crc32c import crc32c
from header import number

KINDS = ("byte", "cut", "longer", "header", "top_table", "codestream", "ROOT", "GROUP", "TILE", "record")


def section_places(data):
    """[(offset, size)] of the four sections of an undamaged stream."""
    table = number(data, 10, 2) - 100
    return [(number(data, table + 24 * i + 8, 8), number(data, table + 24 * i + 16, 8)) for i in range(4)]


def repair(data):
    """Sets the checksums of the sections that are inside the file, and of the header."""
    size = number(data, 10, 2)
    if not 148 <= size <= len(data):
        return bytes(data)
    data = bytearray(data)
    for i, (offset, length) in enumerate(section_places(data)):
        if offset + length <= len(data):
            at = size - 100 + 24 * i + 4
            data[at : at + 4] = crc32c(data[offset : offset + length]).to_bytes(4, "little")
    data[size - 4 : size] = crc32c(data[: size - 4]).to_bytes(4, "little")
    return bytes(data)


def flip(data, rng, offset, size):
    """Inverts one to four bits of a range of bytes."""
    for _ in range(rng.choice([1, 1, 2, 4]) if size > 0 else 0):
        bit = rng.randrange(8 * size)
        data[offset + bit // 8] ^= 1 << bit % 8


def damage_record(data, rng, places):
    """Moves the end of a tile record, or inverts bits of its first bytes."""
    groups = places[2][1] // 16
    if groups == 0:
        return
    at = places[2][0] + 16 * rng.randrange(groups)
    entries, place = bin(number(data, at, 8)).count("1"), number(data, at + 8, 8)
    bits, begin = place >> 48, places[3][0] + place % 2**48
    table_bytes = (entries * bits + 7) // 8
    table = number(data, begin, table_bytes)
    chosen = rng.randrange(entries)
    ends = [0] + [table >> i * bits & 2**bits - 1 for i in range(entries)]
    if rng.random() < 0.5:
        flip(data, rng, begin + table_bytes + ends[chosen], min(12, ends[chosen + 1] - ends[chosen]))
        return
    moved = ends[chosen] + rng.randint(0, ends[chosen + 1] - ends[chosen])
    table += moved - ends[chosen + 1] << chosen * bits
    data[begin : begin + table_bytes] = table.to_bytes(table_bytes, "little")


def damaged(data, rng, kind):
    """A damaged copy of a valid stream; kind is one of KINDS."""
    data, places = bytearray(data), section_places(data)
    header_end = places[0][0] - 4
    if kind == "byte":
        flip(data, rng, 0, len(data))
        return bytes(data)
    if kind == "header":
        data[rng.choice([9, rng.randrange(8, header_end)])] = rng.choice([0, 1, 2, 255])
        data[header_end : header_end + 4] = crc32c(data[:header_end]).to_bytes(4, "little")
        return bytes(data)
    if kind == "cut":
        del data[rng.randrange(len(data)) :]
    elif kind == "longer":
        data += b"\0"
    elif kind == "top_table":
        flip(data, rng, places[0][0], 48)
    elif kind == "codestream":
        flip(data, rng, places[0][0] + 48, places[0][1] - 48)
    elif kind == "record":
        damage_record(data, rng, places)
    else:
        flip(data, rng, *places[("ROOT", "GROUP", "TILE").index(kind) + 1])
    return repair(data)
