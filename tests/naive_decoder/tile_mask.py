"""Which blocks of a tile have motion or a residual (TIL-2 to TIL-4)."""

ALL_BITS = 64


def block_number(i, j):
    """The number of the block in column i and row j of a tile (TIL-2)."""
    return 4 * (4 * (j >> 1) + (i >> 1)) + 2 * (j & 1) + (i & 1)


def blocks_in_plane(geometry, plane, tile_x, tile_y):
    """A mask of the tile's blocks that lie at least partly in the plane."""
    cols, rows = geometry.blocks(plane)
    mask = 0
    for j in range(8):
        for i in range(8):
            if 8 * tile_x + i < cols and 8 * tile_y + j < rows:
                mask += 2 ** block_number(i, j)
    return mask


def read_mask(cursor, mode, inside):
    """The mask that follows in the record, by its mode (TIL-3)."""
    if mode == 0:
        return 0
    if mode == 1:
        return inside
    if mode == 2:
        return cursor.take(ALL_BITS)
    quads = cursor.take(16)
    mask = 0
    for quad in range(16):
        if quads >> quad & 1:
            mask += cursor.take(4) << 4 * quad
    return mask
