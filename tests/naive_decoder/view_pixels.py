"""Pixels of views, and the blocks that they need (NED-1, NED-2, COL-3)."""

from block import BlockDecoder
from colour import to_rgb
from stream_error import StreamError


class ViewPixels:
    """Pixels of the views of a stream, decoded down to a stop level.

    `blocks` has every block that was needed so far by (row, col, plane, block_y, block_x), with the row and
    column of the image at the stop level: its rows of samples, or the StreamError of one that does not decode.
    """

    def __init__(self, stream, stop_level):
        self.header, self.geometry, self.stop_level = stream.header, stream.geometry, stop_level
        self.decoder = BlockDecoder(stream)
        self.blocks = {}

    def pixel(self, row, col, x, y):
        """(R, G, B) of pixel (x, y) of view (row, col); one of a block with an error is black."""
        shift = 1 if self.header.chroma_format == 0 else 0
        luma = self._sample(row, col, 0, x, y)
        co, cg = (self._sample(row, col, plane, x >> shift, y >> shift) for plane in (1, 2))
        return to_rgb(luma, co, cg, self.header.depth)

    def _sample(self, row, col, plane, x, y):
        side = self.geometry.block
        _, image_row, image_col = self.geometry.ancestor(self.stop_level, row, col)
        key = image_row, image_col, plane, y // side, x // side
        if key not in self.blocks:
            try:
                levels = self.decoder.decode(row, col, plane, x // side, y // side, self.stop_level)
                self.blocks[key] = levels[-1].sample
            except StreamError as error:
                self.blocks[key] = error
        rows = self.blocks[key]
        return 0 if isinstance(rows, StreamError) else rows[y % side][x % side]

    def require_all(self):
        """Raises the error of the first needed block that does not decode, with its place (NED-2)."""
        for key in sorted(key for key, rows in self.blocks.items() if isinstance(rows, StreamError)):
            row, col, plane, block_y, block_x = key
            place = self.stop_level, row, col, plane, block_x, block_y
            raise StreamError(self.blocks[key].name, place) from self.blocks[key]
