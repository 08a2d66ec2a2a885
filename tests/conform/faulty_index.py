"""Faults of the index, planted in the naive decoder."""

import copy

import block
import header
import index
import opening
from faulty_checks import check
from integers import ceil_div, rank
from stream_error import StreamError, require


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
def first_of_empty_groups():
    """IDX-4 with `first` checked where mask is 0, too."""

    def checked(entry, records):
        require(header.number(entry, 8, 8) <= records, "bad_root_entry")
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


def clear_top_bit(at):
    """Clears the top bit of byte `at` of all group records of an opened stream."""
    right = opening.Stream.__init__

    def open_stream(self, *data):
        right(self, *data)
        self.group = bytes(byte & 127 if i % 16 == at else byte for i, byte in enumerate(self.group))

    opening.Stream.__init__ = open_stream


@check
def data_of_47_bits():
    """IDX-5 with bit 47 of place ignored."""
    clear_top_bit(13)


@check
def top_bit_of_place_ignored():
    """IDX-5 with bit 63 of place ignored."""
    clear_top_bit(15)


@check
def ends_of_31_bits():
    """IDX-6 with bit 31 of ends ignored."""

    class Table(index.BitString):
        def field(self, position, bits):
            return super().field(position, bits) % 2**31 if bits == 32 else super().field(position, bits)

    index.BitString = Table


@check
def record_one_byte_past():
    """IDX-6 with records that may end one byte past TILE."""
    right = block.find_record

    def find_record(stream, tile):
        try:
            return right(stream, tile)
        except StreamError as error:
            if error.name != "bad_tile_offset":
                raise
            longer = copy.copy(stream)
            longer.tile += bytes(1)
            return right(longer, tile)

    block.find_record = find_record


@check
def table_padding_checked():
    """IDX-6 with padding of the end table that must be 0, in streams of one tile group."""
    right = block.find_record

    def find_record(stream, tile):
        record = right(stream, tile)
        mask, place = header.number(stream.group, 0, 8), header.number(stream.group, 8, 8)
        bits = mask.bit_count() * (place >> 48)
        table = header.number(stream.tile, place % 2**48, ceil_div(bits, 8))
        require(table >> bits == 0, "bad_group_record")
        return record

    block.find_record = find_record
