"""Images, planes, blocks and tiles, and their numbers (STR, IDX-1, IDX-2, MOT-1, EXT-4).

An image is a tuple (level, row, col). Planes: 0 Y, 1 Co, 2 Cg, 3 and 4 the motion planes.
"""

from functools import cache

from groups import Groups
from integers import ceil_div

TILE_BLOCKS = 8  # blocks along the side of a tile (STR-6)


class Geometry:
    """Sizes and numbers that follow from the header alone."""

    def __init__(self, header):
        self.header = header
        self.top = header.tree_height
        self.block = 2**header.block_log2
        self.grids = [(header.rows, header.cols)]  # the views (STR-1), then the levels above them (STR-3)
        for _ in range(header.tree_height):
            rows, cols = self.grids[-1]
            self.grids.append((ceil_div(rows, header.cluster_rows), ceil_div(cols, header.cluster_cols)))
        for method in (self.reference_of, self.is_key, self.plane_size, self.interval, self.tiles, self.tiles_before):
            setattr(self, method.__name__, cache(method))  # asked for once a sample or block
        self.planes = [0, 1, 2]
        if header.motion_tiles:
            self.planes += [3, 4] if header.chroma_motion else [3]

    def row_groups(self, level):
        """The rows of reference groups of a level."""
        return Groups(self.grids[level][0], self.header.levels[level][0], self.header.balanced_groups)

    def col_groups(self, level):
        """The columns of reference groups of a level."""
        return Groups(self.grids[level][1], self.header.levels[level][1], self.header.balanced_groups)

    def reference_of(self, image):
        """The reference image of the image's own group (STR-4)."""
        level, row, col = image
        rows, cols = self.row_groups(level), self.col_groups(level)
        return level, rows.reference(rows.group_of(row)), cols.reference(cols.group_of(col))

    def is_keyed(self, level):
        """EXT-4."""
        return level == self.top or self.header.levels[level][2] == 1

    def is_key(self, image):
        """Whether it is a key image (STR-5, EXT-4)."""
        return self.is_keyed(image[0]) and self.reference_of(image) == image

    def ancestor(self, level, row, col):
        """The ancestor of view (row, col) at a level (DEC-1)."""
        return level, row // self.header.cluster_rows**level, col // self.header.cluster_cols**level

    def images(self):
        """All images in ascending numbers (IDX-1)."""
        for level in range(self.top, -1, -1):
            rows, cols = self.grids[level]
            for row in range(rows):
                for col in range(cols):
                    yield level, row, col

    def image_count(self):
        """The number of images."""
        return sum(rows * cols for rows, cols in self.grids)

    def image_number(self, image):
        """IDX-1."""
        level, row, col = image
        above = sum(rows * cols for rows, cols in self.grids[level + 1 :])
        return above + row * self.grids[level][1] + col

    def plane_size(self, plane):
        """(width, height) of a plane (STR-2) or motion plane (MOT-1) in samples."""
        width, height = self.header.width, self.header.height
        if plane in (1, 2, 4) and self.header.chroma_format == 0:
            return ceil_div(width, 2), ceil_div(height, 2)
        return width, height

    def interval(self, plane):
        """[lo, hi] of the samples of a plane (STR-7)."""
        greatest = 2**self.header.depth - 1
        return (0 if plane == 0 else -greatest), greatest

    def blocks(self, plane):
        """(columns, rows) of blocks of a plane (STR-6)."""
        width, height = self.plane_size(plane)
        return ceil_div(width, self.block), ceil_div(height, self.block)

    def tile_side(self, plane):
        """Samples along the side of a tile of a plane (STR-6) or motion plane (MOT-1)."""
        return TILE_BLOCKS * self.block if plane < 3 else 2**self.header.motion_tile_log2

    def tiles(self, plane):
        """(columns, rows) of tiles of a plane."""
        width, height = self.plane_size(plane)
        return ceil_div(width, self.tile_side(plane)), ceil_div(height, self.tile_side(plane))

    def tiles_before(self, plane):
        """Tiles of an image in the planes before this one."""
        return sum(cols * rows for cols, rows in map(self.tiles, self.planes[:plane]))

    def tiles_of_image(self):
        """Tiles of an image in all planes."""
        return self.tiles_before(len(self.planes))

    def tile_number(self, image, plane, tile_x, tile_y):
        """IDX-2."""
        within = self.tiles_before(plane) + tile_y * self.tiles(plane)[0] + tile_x
        return self.image_number(image) * self.tiles_of_image() + within
