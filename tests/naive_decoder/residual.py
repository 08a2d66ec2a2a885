"""The residual of one block of a tile record (TIL-8 to TIL-10, STP-1 to STP-3)."""

import bise
from bit_string import Cursor
from integers import clamp, rank
from stream_error import require

GREATEST_STEP_CODE = 15


def step_of(code):
    """The step of a step code (STP-2)."""
    if code == 0:
        return 1
    return 2 ** ((code + 1) // 2) if code % 2 else 3 * 2 ** ((code - 2) // 2)


def residual_of(value, levels, bias, step, bound):
    """The residual of one BISE value (TIL-10, STP-3)."""
    return clamp(step * clamp(value - (levels >> 1) + bias, -bound, bound), -bound, bound)


def read_residual(stream, head, plane, block):
    """Rows of B residuals of a block of the residual mask."""
    geometry, header = stream.geometry, stream.header
    side = geometry.block
    m = rank(head.residual_mask, block)
    greatest_level = 27 + 3 * (header.depth - 8)
    cursor = Cursor(head.record, head.block_headers)
    lengths = []
    for _ in range(m + 1):
        level_code = head.level_base + cursor.take(head.level_bits)
        require(level_code <= greatest_level, "bad_levels")
        step_code = head.step_base + cursor.take(head.step_bits)
        require(step_code <= GREATEST_STEP_CODE, "bad_levels")
        bias_at = cursor.skip(head.bias_bits)
        levels = bise.levels_of(level_code)
        lengths.append(bise.sequence_bits(side * side, levels))
    bias = Cursor(head.record, bias_at).take_signed(head.bias_bits)
    values = bise.read(head.record, head.block_values + sum(lengths[:m]), side * side, levels)
    lo, hi = geometry.interval(plane)
    bound = hi - lo
    scaled = [residual_of(value, levels, bias, step_of(step_code), bound) for value in values]
    return [scaled[side * y : side * (y + 1)] for y in range(side)]
