"""Faults of the checks of header, sections and index, planted in the naive decoder."""

import block
import header
import index
import opening
from faulty_checks import check
from integers import rank
from stream_error import StreamError, require


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
def data_of_empty_groups():
    """IDX-6 with data that must lie in TILE, in streams of one tile group, for empty tiles too."""
    right = block.find_record

    def find_record(stream, tile):
        require(int.from_bytes(stream.group[8:14], "little") <= len(stream.tile), "bad_group_record")
        return right(stream, tile)

    block.find_record = find_record


def change_root_entries(change):
    """Replaces each root entry of an opened stream by change(entry, group records)."""
    right = opening.Stream.__init__

    def opened(self, *data):
        right(self, *data)
        entries = [self.root[at : at + 16] for at in range(0, len(self.root), 16)]
        self.root = b"".join(change(entry, len(self.group) // 16) for entry in entries)

    opening.Stream.__init__ = opened


@check
def first_of_32_bits():
    """IDX-4 with `first` cut to 32 bits."""
    change_root_entries(lambda entry, _: entry[:12] + bytes(len(entry[12:])))


@check
def record_for_each_mask_bit():
    """IDX-4 with a record required for each bit of mask, when the stream is opened."""

    def checked(entry, records):
        mask, first = header.number(entry, 0, 8), header.number(entry, 8, 8)
        require(first + mask.bit_count() <= records, "bad_root_entry")
        return entry

    change_root_entries(checked)


@check
def tiles_that_exist_alone():
    """IDX-5 with tile_mask bits of tiles that do not exist taken for 0, in streams of one tile group."""
    right = opening.Stream.__init__

    def open_stream(self, data):
        right(self, data)
        tiles = self.geometry.image_count() * self.geometry.tiles_of_image()
        if tiles < 64 and self.group:
            mask = header.number(self.group, 0, 8) % 2**tiles
            self.group = mask.to_bytes(8, "little") + self.group[8:]

    opening.Stream.__init__ = open_stream


@check
def empty_tiles_unchecked():
    """IDX-5 with the group record checked for tiles that are not empty alone."""
    right = block.find_record

    def find_record(stream, tile):
        try:
            return right(stream, tile)
        except StreamError as error:
            mask = header.number(stream.group, 0, 8)
            if error.name == "bad_group_record" and tile < 64 and mask >> tile & 1 == 0:
                return None
            raise

    block.find_record = find_record


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


@check
def record_number_of_64_bits():
    """IDX-4 with first + rank cut to 64 bits, in streams of one root entry."""
    right, entry = opening.Stream.__init__, []

    def open_stream(self, *data):
        right(self, *data)
        entry[:] = [header.number(self.root, at, 8) for at in (0, 8)]

    def cut_rank(mask, position):
        found = rank(mask, position)
        return (entry[1] + found) % 2**64 - entry[1] if mask == entry[0] else found

    opening.Stream.__init__ = open_stream
    index.rank = cut_rank


@check
def top_bit_of_place_ignored():
    """IDX-5 with bit 63 of place ignored."""
    right = opening.Stream.__init__

    def open_stream(self, *data):
        right(self, *data)
        self.group = bytes(byte & 127 if at % 16 == 15 else byte for at, byte in enumerate(self.group))

    opening.Stream.__init__ = open_stream


@check
def last_reserved_byte_ignored():
    """EXT-2 with the first three of the four reserved bytes checked."""
    right = header.read_extended_fields
    header.read_extended_fields = lambda fields, data: right(fields, data[:43] + bytes(1))


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
