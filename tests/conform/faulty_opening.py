"""Faults of the checks of header and sections, planted in the naive decoder."""

import header
import opening
from faulty_checks import check
from integers import signed
from stream_error import require


def check_sections_early(check_sections):
    """Adds check_sections(fields, sections) before all checks that follow FIL-4."""
    right = opening.read_sections

    def read_sections(fields, data):
        sections = right(fields, data)
        check_sections(fields, sections)
        return sections

    opening.read_sections = read_sections


@check
def top_before_sizes():
    """The TOP table (KEY-1) before the sizes of ROOT and GROUP (IDX-4, IDX-5)."""
    check_sections_early(lambda fields, sections: opening.read_top_table(opening.Geometry(fields), sections[-4]))


@check
def crc_before_sizes():
    """FIL-8 with the crc of the sections first."""

    def check_crcs(fields, sections):
        for (_, crc, _, _), section in zip(fields.sections, sections):
            require(opening.crc32c(section) == crc, "bad_section_crc")

    check_sections_early(check_crcs)


@check
def key_references_unchecked():
    """EXT-4 with key_references ignored without level_keys."""
    right = header.read_level_entries

    def read_level_entries(fields, data):
        flag, fields.level_keys = fields.level_keys, True
        right(fields, data)
        fields.level_keys = flag
        if not flag:
            fields.levels = {level: (*entry[:2], 0) for level, entry in fields.levels.items()}

    header.read_level_entries = read_level_entries


@check
def sections_unchecked():
    """FIL-6 by a decoder that reads whole sections and claims to check them."""

    def require_others(condition, which):
        if which != "bad_section_crc":
            require(condition, which)

    opening.require = require_others


def ignore_reserved_byte(at):
    right = header.read_extended_fields
    header.read_extended_fields = lambda fields, data: right(fields, data[:at] + bytes(1) + data[at + 1 :])


@check
def second_reserved_byte_ignored():
    """EXT-2 with the second of the four reserved bytes ignored."""
    ignore_reserved_byte(41)


@check
def third_reserved_byte_ignored():
    """EXT-2 with the third of the four reserved bytes ignored."""
    ignore_reserved_byte(42)


@check
def last_reserved_byte_ignored():
    """EXT-2 with the first three of the four reserved bytes checked."""
    ignore_reserved_byte(43)


@check
def magic_of_seven_bytes():
    """FIL-4 with the last byte of the magic ignored."""
    right = opening.read_header

    def read_header(data):
        header.MAGIC = header.MAGIC[:7] + data[7:8]
        return right(data)

    opening.read_header = read_header


@check
def features_of_31_bits():
    """EXT-1 with bit 31 of feature_flags ignored."""
    right = header.read_flags
    header.read_flags = lambda fields, flags: right(fields, flags % 2**31)


def limit_field(name, greatest):
    header.FIELDS[:] = [(*field[:4], greatest) if field[0] == name else field for field in header.FIELDS]


@check
def tree_height_16():
    """FIL-1 with trees of height 16."""
    limit_field("tree_height", 16)


@check
def rows_4095():
    """LVL-1 with a grid of at most 4095 rows."""
    limit_field("rows", 4095)


@check
def height_65535():
    """LVL-1 with views of at most 65535 rows."""
    limit_field("height", 65535)


@check
def vector_precision_4():
    """EXT-2 with vectors in sixteenths of samples."""
    right = header.read_extended_fields

    def read_extended_fields(fields, data):
        right(fields, data[:35] + bytes([3]) + data[36:] if data[35] == 4 else data)

    header.read_extended_fields = read_extended_fields


@check
def types_of_31_bits():
    """FIL-3 with bit 31 of a section's type ignored."""
    right = opening.read_sections

    def read_sections(fields, data):
        fields.sections = [(kind % 2**31, *entry) for kind, *entry in fields.sections]
        return right(fields, data)

    opening.read_sections = read_sections


@check
def top_sizes_signed():
    """KEY-1 with sizes of codestreams as signed numbers."""
    right = opening.number

    def number(data, at, size):
        return signed(right(data, at, size), 32) if at % 16 == 8 else right(data, at, size)

    opening.number = number


@check
def tiles_of_32_bits():
    """IDX-3 with the number of tiles cut to 32 bits."""
    right = opening.ceil_div
    opening.ceil_div = lambda tiles, share: right(tiles % 2**32, share)


@check
def rig_of_16_bits():
    """RIG-1 with at most 65535 bytes in RIG."""

    def check_rig(fields, sections):
        require(not fields.camera_rig or len(sections[0]) < 2**16, "bad_section_size")

    check_sections_early(check_rig)


@check
def features_before_profile():
    """FIL-4 with bits of feature_flags that no profile has before the profile."""
    right = header.crc32c

    def crc_and_features(data):
        if len(data) >= 16:
            features.append(header.number(data, 12, 4))
        return right(data)

    def require_features_first(condition, which):
        require(which != "bad_profile" or features[-1] < 2 ** len(header.FLAGS), "bad_feature")
        require(condition, which)

    features = []
    header.crc32c = crc_and_features
    header.require = require_features_first
