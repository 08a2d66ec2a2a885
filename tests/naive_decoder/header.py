"""The header (FIL-1 to FIL-4, EXT-1, EXT-2, EXT-4)."""

from crc32c import crc32c
from integers import signed
from stream_error import require

MAGIC = bytes.fromhex("89484D4C46430D0A")

# Field, offset, bytes, least and greatest value, in the order of FIL-1.
FIELDS = [
    ("rows", 16, 2, 1, 4096),
    ("cols", 18, 2, 1, 4096),
    ("width", 20, 4, 1, 65536),
    ("height", 24, 4, 1, 65536),
    ("depth", 28, 1, 8, 12),
    ("chroma_format", 29, 1, 0, 1),
    ("block_log2", 30, 1, 1, 3),
    ("window", 31, 1, 0, 127),
    ("cluster_rows", 32, 1, 1, 255),
    ("cluster_cols", 33, 1, 1, 255),
    ("tree_height", 34, 1, 0, 15),
]

# Flag of each bit of feature_flags and the flag that it needs (EXT-1).
FLAGS = [
    ("residual_step", None),
    ("motion_tiles", None),
    ("subpel_vectors", "motion_tiles"),
    ("shared_disparity", "motion_tiles"),
    ("two_references", "motion_tiles"),
    ("chroma_motion", "motion_tiles"),
    ("lossy_keys", None),
    ("level_keys", None),
    ("balanced_groups", None),
    ("camera_rig", None),
]


class Header:
    """Every field of the header and every flag, by name.

    `levels[l]` is (ref_rows, ref_cols, key_references) of level l; `sections` is a list of
    (type, crc, offset, size) in the order of the file, RIG first where there is one.
    """


def number(data, offset, size):
    """An unsigned little-endian integer (CNV-3)."""
    return int.from_bytes(data[offset : offset + size], "little")


def read_header(data):
    """The header of a file, checked in the order of FIL-4 up to the level entries."""
    require(len(data) >= 12, "truncated")
    require(data[:8] == MAGIC, "bad_magic")
    require(data[8] == 1, "bad_version")
    header = Header()
    header.header_bytes = size = number(data, 10, 2)
    require(size >= 148 and len(data) >= size, "truncated")
    require(number(data, size - 4, 4) == crc32c(data[: size - 4]), "bad_header_crc")
    header.profile = data[9]
    require(header.profile in (0, 1), "bad_profile")
    read_flags(header, number(data, 12, 4))
    for name, offset, width, least, greatest in FIELDS:
        setattr(header, name, number(data, offset, width))
        require(least <= getattr(header, name) <= greatest, "bad_header_field")
    many = header.cluster_rows * header.cluster_cols >= 2
    require(many or header.tree_height == 0, "bad_header_field")
    read_extended_fields(header, data)
    count = 5 if header.camera_rig else 4
    require(size == 44 + 4 * (header.tree_height + 1) + 24 * count + 4, "bad_header_field")
    read_level_entries(header, data)
    table = size - 4 - 24 * count
    header.sections = [
        tuple(number(data, table + 24 * i + at, width) for at, width in ((0, 4), (4, 4), (8, 8), (16, 8)))
        for i in range(count)
    ]
    return header


def read_flags(header, flags):
    """EXT-1; profile main has no flags."""
    for position, (name, _) in enumerate(FLAGS):
        setattr(header, name, flags >> position & 1 == 1)
    require(flags < 2 ** len(FLAGS), "bad_feature")
    require(header.profile == 1 or flags == 0, "bad_feature")
    for name, needed in FLAGS:
        require(needed is None or not getattr(header, name) or getattr(header, needed), "bad_feature")


def read_extended_fields(header, data):
    """EXT-2; in profile main no flag is set, so all must be 0."""

    def take(name, offset, flag, least, greatest):
        value = data[offset]
        setattr(header, name, value)
        inside = least <= value <= greatest if flag else value == 0
        require(inside, "bad_header_field")

    take("vector_precision", 35, header.subpel_vectors, 1, 3)
    take("disparity_precision", 36, header.shared_disparity, header.vector_precision, 5)
    take("motion_tile_log2", 37, header.motion_tiles, 5, 7)
    take("disparity_grid_log2", 38, header.shared_disparity, 2, 5)
    header.row_scale = signed(data[39], 8)
    in_range = header.row_scale >= -127 if header.shared_disparity else header.row_scale == 0
    require(in_range, "bad_header_field")
    require(data[40:44] == bytes(4), "bad_header_field")


def read_level_entries(header, data):
    """FIL-2, EXT-4: from the top level to level 0."""
    header.levels = {}
    for i in range(header.tree_height + 1):
        level = header.tree_height - i
        ref_rows, ref_cols, key_references, reserved = data[44 + 4 * i : 48 + 4 * i]
        require(ref_rows >= 1 and ref_cols >= 1, "bad_header_field")
        may_be_keyed = header.level_keys and level < header.tree_height
        require(key_references <= (1 if may_be_keyed else 0), "bad_header_field")
        require(reserved == 0, "bad_header_field")
        header.levels[level] = (ref_rows, ref_cols, key_references)
