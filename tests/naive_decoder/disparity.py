"""Disparities that a reference group shares (MOT-5, MOT-6)."""

from functools import lru_cache

import bise
from bit_string import Cursor
from index import find_record
from integers import ceil_div, clamp
from motion import EXPLICIT_DISPARITY
from stream_error import require

# Steps of choices 1 to 9 in columns and rows of grid blocks (MOT-5).
NEIGHBOURS = [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (1, -1), (-1, 1), (1, 1)]
GREATEST_CODE = 27


def disparity_of(stream, image, motion_plane, motion, x, y):
    """The disparity of a block with the place (x, y) whose choice is one of 1 to 10."""
    if motion.choice == EXPLICIT_DISPARITY:
        return motion.explicit_x
    geometry, side = stream.geometry, 2**stream.header.disparity_grid_log2
    step_x, step_y = NEIGHBOURS[motion.choice - 1]
    width, height = geometry.plane_size(motion_plane)
    grid_x = clamp(x // side + step_x, 0, ceil_div(width, side) - 1)
    grid_y = clamp(y // side + step_y, 0, ceil_div(height, side) - 1)
    return grid_disparity(stream, geometry.reference_of(image), motion_plane, grid_x, grid_y)


def grid_disparity(stream, reference, motion_plane, grid_x, grid_y):
    """The disparity of a grid block of a reference image (MOT-6)."""
    in_tile = stream.geometry.tile_side(motion_plane) // 2**stream.header.disparity_grid_log2
    tile = read_disparity_tile(stream, reference, motion_plane, grid_x // in_tile, grid_y // in_tile)
    if tile is None:
        return 0
    least, cols, values = tile
    disparity = least + values[grid_y % in_tile * cols + grid_x % in_tile]
    require(-4096 <= disparity <= 4095, "vector_range")
    return disparity


@lru_cache
def read_disparity_tile(stream, reference, motion_plane, tile_x, tile_y):
    """(least disparity, columns of grid blocks, values) of a tile (MOT-6), None for an empty one."""
    geometry, side = stream.geometry, 2**stream.header.disparity_grid_log2
    tile_side = geometry.tile_side(motion_plane)
    record = find_record(stream, geometry.tile_number(reference, motion_plane, tile_x, tile_y))
    if record is None:
        return None
    cursor = Cursor(record)
    least = cursor.take_signed(13)
    code = cursor.take(5)
    require(code <= GREATEST_CODE, "bad_levels")
    width, height = geometry.plane_size(motion_plane)
    cols = ceil_div(min(tile_side, width - tile_x * tile_side), side)
    rows = ceil_div(min(tile_side, height - tile_y * tile_side), side)
    return least, cols, bise.read(record, cursor.position, cols * rows, bise.levels_of(code))
