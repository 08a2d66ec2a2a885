"""Resolutions, subbands and code-blocks of one tile at the origin (T.800 B.5 to B.7)."""

from .tag_tree import TagTree


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


class Subband:
    """A subband: kind "LL", "HL", "LH" or "HH", size, code-blocks in raster order, tag trees."""

    def __init__(self, kind, index, width, height, codestream):
        self.kind, self.width, self.height = kind, width, height
        self.planes = codestream.guard_bits + codestream.exponents[index] - 1
        step_x, step_y = codestream.block_width, codestream.block_height
        self.blocks = [
            CodeBlock(x, y, min(step_x, width - x), min(step_y, height - y))
            for y in range(0, height, step_y)
            for x in range(0, width, step_x)
        ]
        if self.blocks:
            self.cols, rows = -(-width // step_x), -(-height // step_y)
            self.inclusion, self.zero_planes = TagTree(self.cols, rows), TagTree(self.cols, rows)


def resolutions(codestream):
    """The subbands of each resolution, from the least one."""
    count, width, height = codestream.decompositions, codestream.width, codestream.height
    lowest = Subband("LL", 0, ceil_shift(width, count), ceil_shift(height, count), codestream)
    result = [[lowest]]
    for resolution in range(1, count + 1):
        down = count - resolution
        full = ceil_shift(width, down), ceil_shift(height, down)
        low = (full[0] + 1) // 2, (full[1] + 1) // 2
        high = full[0] - low[0], full[1] - low[1]
        first = 3 * resolution - 2
        result.append([
            Subband("HL", first, high[0], low[1], codestream),
            Subband("LH", first + 1, low[0], high[1], codestream),
            Subband("HH", first + 2, high[0], high[1], codestream),
        ])
    return result
