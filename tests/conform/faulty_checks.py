"""Faults of a decoder's checks, planted in the naive decoder: the samples are right, the errors are not."""

import block
import header
import index
import key_images
import motion
import opening
import residual
import tile_head
from bit_string import Cursor
from stream_error import StreamError, require

CHECKS = {}


def check(fault):
    CHECKS[fault.__name__] = fault
    return fault


def report_late(module, error, owner, name):
    """`error`, where `module` requires it, is met only when function `name` of `owner` has made all other checks."""
    wrong, right = [], getattr(owner, name)

    def require_others(condition, which):
        if which != error:
            require(condition, which)
        elif not condition:
            wrong.append(which)

    def checked(*arguments):
        wrong.clear()
        result = right(*arguments)
        require(not wrong, error)
        return result

    module.require = require_others
    setattr(owner, name, checked)


@check
def range_before_crc():
    """KEY-3 with the range of samples first."""
    report_late(key_images, "bad_top_crc", block, "decode_key_plane")


@check
def codes_before_vectors():
    """TIL-6 with codes_x and codes_y before min_x and min_y."""
    report_late(tile_head, "vector_range", tile_head.TileHead, "_read_vector_ranges")


@check
def top_before_sizes():
    """The TOP table (KEY-1) before the sizes of ROOT and GROUP (IDX-4, IDX-5)."""
    right = opening.read_sections

    def read_sections(fields, data):
        sections = right(fields, data)
        opening.read_top_table(opening.Geometry(fields), sections[0])
        return sections

    opening.read_sections = read_sections


@check
def residual_before_motion():
    """MOT-10 with the residual tile first."""
    right = block.BlockDecoder._entry

    def entry(self, *place):
        self._tiled_motion = lambda *_: (1, [])
        right(self, *place)
        del self._tiled_motion
        return right(self, *place)

    block.BlockDecoder._entry = entry


@check
def own_before_parent():
    """DEC-1 from the view upwards."""
    right = block.BlockDecoder.decode

    def decode_block(self, row, col, plane, block_x, block_y, level=0):
        for l in range(level, self.stream.geometry.top + 1):
            image = self.stream.geometry.ancestor(l, row, col)
            if self.stream.geometry.is_key(image):
                break
            self.entry(image, plane, block_x, block_y)
        return right(self, row, col, plane, block_x, block_y, level)

    block.BlockDecoder.decode = decode_block


@check
def second_reference_first():
    """MOT-10 with the second of two references first."""
    right = block.BlockDecoder._reference
    block.BlockDecoder._reference = lambda self, parts, *place: right(self, parts[::-1], *place)


@check
def vectors_with_head():
    """TIL-1 with the components of all vectors (TIL-7) before the rest of the head."""
    right = tile_head.TileHead._read_residual_widths

    def read_residual_widths(self, cursor, fields):
        if self.motion_mask:
            count = tile_head.popcount(self.motion_mask)
            for least, levels, at in zip(self.least, self.levels, self.vectors):
                components = [least + value for value in motion.bise.read(self.record, at, count, levels)]
                require(all(abs(component) <= fields.window for component in components), "vector_range")
        right(self, cursor, fields)

    tile_head.TileHead._read_residual_widths = read_residual_widths


@check
def crc_before_sizes():
    """FIL-8 with the crc of the sections first."""
    right = opening.read_sections

    def read_sections(fields, data):
        sections = right(fields, data)
        for (_, crc, _, _), section in zip(fields.sections, sections):
            require(opening.crc32c(section) == crc, "bad_section_crc")
        return sections

    opening.read_sections = read_sections


@check
def levels_with_head():
    """TIL-1 with the level codes of all block headers (TIL-8) before the record's end."""
    right = tile_head.TileHead._read_residual_widths

    def read_residual_widths(self, cursor, fields):
        right(self, cursor, fields)
        headers = Cursor(self.record, cursor.position)
        width = self.level_bits + self.step_bits + self.bias_bits
        while headers.position + width <= self.record.length:
            require(self.level_base + headers.take(self.level_bits) <= 27 + 3 * (fields.depth - 8), "bad_levels")
            headers.skip(width - self.level_bits)
            if headers.position >= cursor.position + width * tile_head.popcount(self.residual_mask):
                break

    tile_head.TileHead._read_residual_widths = read_residual_widths


@check
def steps_with_values():
    """STP-1 with the step code after the block's values were read."""
    report_late(residual, "bad_levels", block, "read_residual")


@check
def data_of_empty_groups():
    """IDX-6 with data that must lie in TILE, in streams of one tile group, for empty tiles too."""
    right = block.find_record

    def find_record(stream, tile):
        require(int.from_bytes(stream.group[8:14], "little") <= len(stream.tile), "bad_group_record")
        return right(stream, tile)

    block.find_record = find_record


@check
def masks_one_by_one():
    """TIL-4 with motion_mask checked before residual_mask is read."""
    right = tile_head.read_mask

    def read_mask(cursor, mode, inside):
        mask = right(cursor, mode, inside)
        require(mask & ~inside == 0, "mask_outside")
        return mask

    tile_head.read_mask = read_mask


@check
def motion_block_at_once():
    """MOT-3 with m checked before explicit_bits is read."""
    right = motion.read_motion_tile

    def read_motion_tile(stream, image, motion_plane, tile_x, tile_y):
        record = index.find_record(stream, stream.geometry.tile_number(image, motion_plane, tile_x, tile_y))
        if record is not None:
            require(4 * 2 ** Cursor(record).take(2) >= stream.geometry.block, "bad_mode")
        return right(stream, image, motion_plane, tile_x, tile_y)

    motion.read_motion_tile = read_motion_tile


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
