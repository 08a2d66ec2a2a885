"""Resolutions, subbands, precincts and code-blocks of one tile at the origin (T.800 B.5 to B.7)."""

from .tag_tree import TagTree

PRECINCT = 32768  # samples along the side of a precinct of the greatest size


def ceil_shift(x, k):
    """ceil(x / 2^k)."""
    return (x + 2**k - 1) >> k


class CodeBlock:
    """One code-block: its place in the subband, and what packets said of it."""

    def __init__(self, x, y, width, height):
        self.x, self.y, self.width, self.height = x, y, width, height
        self.included = False
        self.missing_planes = 0
        self.length_bits = 3
        self.passes = 0
        self.segments = []  # [number of passes, bytes] of each codeword segment


class Precinct:
    """The part of a subband in one precinct: code-blocks in raster order and their tag trees."""

    def __init__(self, planes, blocks):
        self.planes, self.blocks = planes, blocks
        self.cols = len({block.x for block in blocks})
        if blocks:
            rows = len(blocks) // self.cols
            self.inclusion, self.zero_planes = TagTree(self.cols, rows), TagTree(self.cols, rows)


class Subband:
    """A subband: kind "LL", "HL", "LH" or "HH", size, code-blocks in raster order."""

    def __init__(self, kind, index, width, height, codestream):
        self.kind, self.width, self.height = kind, width, height
        self.planes = codestream.guard_bits + codestream.exponents[index] - 1
        step_x, step_y = codestream.block_width, codestream.block_height
        self.blocks = [
            CodeBlock(x, y, min(step_x, width - x), min(step_y, height - y))
            for y in range(0, height, step_y)
            for x in range(0, width, step_x)
        ]

    def precinct(self, col, row):
        """The part of the subband in a precinct of its resolution."""
        side = PRECINCT if self.kind == "LL" else PRECINCT // 2
        inside = [block for block in self.blocks if (block.x // side, block.y // side) == (col, row)]
        return Precinct(self.planes, inside)


class Resolution:
    """One or three subbands; precincts[row, col] is the list of their parts in that precinct."""

    def __init__(self, width, height, bands):
        self.bands = bands
        self.precincts = {
            (row, col): [band.precinct(col, row) for band in bands]
            for row in range(-(-height // PRECINCT))
            for col in range(-(-width // PRECINCT))
        }


def resolutions(codestream):
    """All resolutions, from the least one."""
    count, width, height = codestream.decompositions, codestream.width, codestream.height
    least = ceil_shift(width, count), ceil_shift(height, count)
    result = [Resolution(*least, [Subband("LL", 0, *least, codestream)])]
    for resolution in range(1, count + 1):
        down = count - resolution
        full = ceil_shift(width, down), ceil_shift(height, down)
        low = (full[0] + 1) // 2, (full[1] + 1) // 2
        high = full[0] - low[0], full[1] - low[1]
        first = 3 * resolution - 2
        bands = [
            Subband("HL", first, high[0], low[1], codestream),
            Subband("LH", first + 1, low[0], high[1], codestream),
            Subband("HH", first + 2, high[0], high[1], codestream),
        ]
        result.append(Resolution(*full, bands))
    return result
