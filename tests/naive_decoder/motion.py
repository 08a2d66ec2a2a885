"""How a block is moved: what the record of a motion tile says (MOT-3, MOT-4)."""

from functools import lru_cache

import bise
from bit_string import Cursor
from index import find_record
from integers import ceil_div
from stream_error import require

NO_MOTION, OWN_DISPARITY, EXPLICIT_DISPARITY, EXPLICIT_VECTOR = 0, 1, 10, 11


class Motion:
    """A palette entry: reference_set, choice, sign (1 or -1), explicit_x, explicit_y."""

    def __init__(self, reference_set, choice, sign, explicit_x=0, explicit_y=0):
        self.reference_set, self.choice, self.sign = reference_set, choice, sign
        self.explicit_x, self.explicit_y = explicit_x, explicit_y


def place_of(stream, plane, block_x, block_y):
    """(motion plane, X, Y, doubled) of a residual block (MOT-1, MOT-4)."""
    header, side = stream.header, stream.geometry.block
    motion_plane = 4 if header.chroma_motion and plane > 0 else 3
    doubled = plane > 0 and header.chroma_format == 0 and motion_plane == 3
    factor = 2 if doubled else 1
    return motion_plane, block_x * side * factor, block_y * side * factor, doubled


def default_motion(stream, level):
    """The motion of every block in an empty motion tile (MOT-4)."""
    reference_set = 1 if stream.header.two_references else 0
    if not stream.geometry.is_keyed(level):
        return Motion(reference_set, NO_MOTION, 1)
    return Motion(reference_set, OWN_DISPARITY if stream.header.shared_disparity else EXPLICIT_VECTOR, 1)


def read_entry(cursor, header, keyed, explicit_bits):
    """One palette entry (MOT-3)."""
    reference_set = cursor.take(3) if header.two_references else 0
    choice = cursor.take(4)
    sign = 1 if keyed or cursor.take(1) == 0 else -1
    x = cursor.take_signed(explicit_bits) if choice in (EXPLICIT_DISPARITY, EXPLICIT_VECTOR) else 0
    y = cursor.take_signed(explicit_bits) if choice == EXPLICIT_VECTOR else 0
    return Motion(reference_set, choice, sign, x, y)


def motion_of(stream, image, motion_plane, x, y):
    """The motion of the residual block with the place (x, y) in a predictive image (MOT-4)."""
    tile_side = stream.geometry.tile_side(motion_plane)
    tile = read_motion_tile(stream, image, motion_plane, x // tile_side, y // tile_side)
    if tile is None:
        return default_motion(stream, image[0])
    side, cols, indices, palette = tile
    index = indices[y % tile_side // side * cols + x % tile_side // side]
    require(index < len(palette), "bad_mode")
    motion = palette[index]
    require(motion.choice <= EXPLICIT_VECTOR, "bad_mode")
    by_disparity = OWN_DISPARITY <= motion.choice <= EXPLICIT_DISPARITY
    require(stream.header.shared_disparity or not by_disparity, "bad_mode")
    return motion


@lru_cache
def read_motion_tile(stream, image, motion_plane, tile_x, tile_y):
    """(samples along the side of a motion block, their columns, indices, palette) of a tile (MOT-3).

    None for an empty tile. Kept, as each block of the tile asks for it.
    """
    header, geometry = stream.header, stream.geometry
    record = find_record(stream, geometry.tile_number(image, motion_plane, tile_x, tile_y))
    if record is None:
        return None
    cursor = Cursor(record)
    side = 4 * 2 ** cursor.take(2)
    palette_size = cursor.take(3) + 1
    explicit_bits = cursor.take(4)
    require(side >= geometry.block and explicit_bits <= 12, "bad_mode")
    keyed = geometry.is_keyed(image[0])
    palette = [read_entry(cursor, header, keyed, explicit_bits) for _ in range(palette_size)]
    tile_side = geometry.tile_side(motion_plane)
    width, height = geometry.plane_size(motion_plane)
    cols = ceil_div(min(tile_side, width - tile_x * tile_side), side)
    rows = ceil_div(min(tile_side, height - tile_y * tile_side), side)
    levels = bise.levels_of(bise.least_code(palette_size))
    return side, cols, bise.read(record, cursor.position, cols * rows, levels), palette
