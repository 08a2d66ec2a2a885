"""Faults of the checks of images and records, planted in the naive decoder: the samples are right, the errors are not."""

import block
import index
import key_images
import motion
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


def exchange_references(reference_set):
    right = block.references_of

    def references_of(geometry, image, found):
        images = right(geometry, image, found)
        return images[::-1] if found.reference_set == reference_set else images

    block.references_of = references_of


@check
def k2_before_k1():
    """MOT-10 with K2 before K1 in reference_set 5."""
    exchange_references(5)


@check
def k3_before_k0():
    """MOT-10 with K3 before K0 in reference_set 6."""
    exchange_references(6)


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


def end_first(name, bits):
    """TIL-1 with the end of all `bits` that function `name` of the head reads checked before the first value."""
    right = getattr(tile_head.TileHead, name)

    def read(self, cursor, argument):
        require(cursor.position + bits(argument) <= self.record.length, "tile_overrun")
        right(self, cursor, argument)

    setattr(tile_head.TileHead, name, read)


@check
def end_before_vector_ranges():
    """TIL-1 with the end of codes_y before the values of sign_mode to codes_y."""

    def bits(window):
        code_bits = tile_head.least_bits(tile_head.least_code(2 * window + 1) + 1)
        return 2 + 2 * (tile_head.least_bits(2 * window + 1) + code_bits)

    end_first("_read_vector_ranges", bits)


@check
def end_before_residual_widths():
    """TIL-1 with the end of bias_bits before the value of level_bits."""
    end_first("_read_residual_widths", lambda fields: 6 + 3 + 4)


@check
def bias_bits_after_steps():
    """TIL-8 with bias_bits checked when step_base and step_bits are read."""
    right = tile_head.TileHead._read_residual_widths

    def read_residual_widths(self, cursor, fields):
        try:
            right(self, cursor, fields)
        except StreamError:
            if self.level_bits <= 6 and fields.residual_step:
                cursor.skip(4 + 2)
                require(cursor.position <= self.record.length, "tile_overrun")
            raise

    tile_head.TileHead._read_residual_widths = read_residual_widths


@check
def values_one_bit_short():
    """TIL-9 with block values that may end one bit past their record."""
    right = residual.bise.read

    def read(record, position, count, levels):
        if position + residual.bise.sequence_bits(count, levels) == record.length + 1:
            record.length += 1
        return right(record, position, count, levels)

    residual.bise.read = read
