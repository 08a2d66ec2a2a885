"""The disparity and confidence of blocks of a view, in exact fractions (section 8 of docs/rendering.md)."""

import math
from fractions import Fraction

from disparity import disparity_of, grid_disparity
from index import find_record
from integers import clamp
from motion import EXPLICIT_DISPARITY, EXPLICIT_VECTOR, NO_MOTION, motion_of, place_of
from references import references_of, vector_to
from residual import read_residual
from stream_error import StreamError
from tile_head import TileHead
from tile_mask import block_number
from vector import read_vector

Y = 0


def sixteen_bits(number):
    """The integer nearest to a fraction, halves away from 0, within 16 bits (GEO-4)."""
    size = math.floor(abs(number) + Fraction(1, 2))
    return clamp(-size if number < 0 else size, -(2**15), 2**15 - 1)


def block_of_map(stream, row, col, block_x, block_y):
    """(D, confidence) of a block of plane Y of view (row, col) (GEO-1, GEO-2); D in 2^-8 pixels a column.

    Raises the StreamError of GEO-7.
    """
    geometry, level = stream.geometry, 0
    while True:
        image = geometry.ancestor(level, row, col)
        told = told_by(stream, image, block_x, block_y)
        if told is not None:
            D, confidence = told
            return sixteen_bits(D * 256), confidence if geometry.is_keyed(level) else 1
        if level == geometry.top or geometry.is_key(image):
            return 0, 0
        level += 1


def told_by(stream, image, block_x, block_y):
    """(pixels a column, confidence at a keyed level) that a block tells, or None (GEO-3, GEO-6)."""
    header, geometry = stream.header, stream.geometry
    level, row, col = image
    rows, cols = geometry.row_groups(level), geometry.col_groups(level)
    if rows.length(rows.group_of(row)) * cols.length(cols.group_of(col)) == 1:
        return None
    predictive = geometry.reference_of(image) != image
    if not header.motion_tiles:
        return told_by_record(stream, image, block_x, block_y) if predictive else None
    unit = 2**header.disparity_precision * min(header.cluster_cols**level, 4096)
    motion_plane, x, y, _ = place_of(stream, Y, block_x, block_y)
    if not predictive:
        if not header.shared_disparity:
            return None
        side = 2**header.disparity_grid_log2
        try:
            return Fraction(grid_disparity(stream, image, motion_plane, x // side, y // side), unit), 3
        except StreamError:
            return None
    motion = motion_of(stream, image, motion_plane, x, y)
    if motion.choice == NO_MOTION:
        return None
    if motion.choice == EXPLICIT_VECTOR:
        reference = references_of(geometry, image, motion)[0]
        vector = vector_to(header, image, reference, motion, None)
        return along(header, image, reference, [Fraction(v, 2**header.vector_precision) for v in vector])
    disparity = disparity_of(stream, image, motion_plane, motion, x, y)
    return Fraction(disparity, unit), 2 if motion.choice == EXPLICIT_DISPARITY else 3


def told_by_record(stream, image, block_x, block_y):
    """By the vector of a residual tile (TIL-7). The walk reads the block's residual as well (GEO-7)."""
    tile = block_x // 8, block_y // 8
    record = find_record(stream, stream.geometry.tile_number(image, Y, *tile))
    if record is None:
        return None
    head, block = TileHead(stream, record, True, Y, tile), block_number(block_x % 8, block_y % 8)
    moved = head.motion_mask >> block & 1
    vector = read_vector(head, stream.header.window, block)[1] if moved else None
    if head.residual_mask >> block & 1:
        read_residual(stream, head, Y, block)
    return along(stream.header, image, stream.geometry.reference_of(image), vector) if moved else None


def along(header, image, reference, vector):
    """A vector in samples over its baseline in columns (GEO-5), and what is aside of it (GEO-6)."""
    level, row, col = image
    pitch = Fraction(header.row_scale or 16, 16)
    x = (reference[2] - col) * min(header.cluster_cols**level, 4096)
    y = (reference[1] - row) * min(header.cluster_rows**level, 4096) * pitch
    length = x * x + y * y
    dot, cross = vector[0] * x + vector[1] * y, vector[0] * y - vector[1] * x
    return Fraction(dot) / length, 2 if cross * cross <= Fraction(1, 4) * length else 1
