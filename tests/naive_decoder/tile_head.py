"""The fields of a tile record that serve all its blocks (TIL-1, TIL-6, TIL-8, STP-1, MOT-2)."""

from bise import least_code, levels_of, sequence_bits
from bit_string import Cursor
from integers import least_bits, popcount
from stream_error import require
from tile_mask import blocks_in_plane, read_mask


class TileHead:
    """The fields by name, and the positions at which signs, vectors, block headers and block values begin."""

    def __init__(self, stream, record, has_motion, plane, tile):
        """Reads the record of `tile` = (column, row); has_motion: motion_mode is present."""
        self.record = record
        header = stream.header
        cursor = Cursor(record)
        inside = blocks_in_plane(stream.geometry, plane, *tile)
        motion_mode = cursor.take(2) if has_motion else 0
        residual_mode = cursor.take(2)
        self.motion_mask = read_mask(cursor, motion_mode, inside)
        self.residual_mask = read_mask(cursor, residual_mode, inside)
        require((self.motion_mask | self.residual_mask) & ~inside == 0, "mask_outside")
        if self.motion_mask:
            self._read_vector_ranges(cursor, header.window)
        if self.residual_mask:
            self._read_residual_widths(cursor, header)
        self.block_headers = cursor.position
        width = self.level_bits + self.step_bits + self.bias_bits if self.residual_mask else 0
        self.block_values = self.block_headers + width * popcount(self.residual_mask)
        require(self.block_values <= record.length, "tile_overrun")

    def _read_vector_ranges(self, cursor, window):
        count = popcount(self.motion_mask)
        value_bits = least_bits(2 * window + 1)
        greatest_code = least_code(2 * window + 1)
        code_bits = least_bits(greatest_code + 1)
        self.sign_mode = cursor.take(2)
        require(self.sign_mode != 3, "bad_mode")
        self.least, self.levels = [], []
        for _ in "xy":
            field = cursor.take(value_bits)
            require(field <= 2 * window, "vector_range")
            self.least.append(field - window)
            code = cursor.take(code_bits)
            require(code <= greatest_code, "bad_levels")
            self.levels.append(levels_of(code))
        self.signs = cursor.skip(count if self.sign_mode == 2 else 0)
        self.vectors = [cursor.skip(sequence_bits(count, levels)) for levels in self.levels]

    def _read_residual_widths(self, cursor, header):
        self.level_base = cursor.take(6)
        self.level_bits = cursor.take(3)
        require(self.level_bits <= 6, "bad_mode")
        self.bias_bits = cursor.take(4)
        require(self.bias_bits <= header.depth + 2, "bad_mode")
        self.step_base = cursor.take(4) if header.residual_step else 0
        self.step_bits = cursor.take(2) if header.residual_step else 0
