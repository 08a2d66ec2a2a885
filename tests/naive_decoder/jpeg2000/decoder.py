"""From a codestream to samples (KEY-2)."""

from .code_block import decode_code_block
from .codestream_error import CodestreamError, demand
from .markers import Codestream
from .packets import read_packets
from .subbands import resolutions
from .wavelet import join

__all__ = ["CodestreamError", "decode"]


def band_rows(band, style):
    """Rows of coefficients of a subband."""
    rows = [[0] * band.width for _ in range(band.height)]
    for block in band.blocks:
        for y, row in enumerate(decode_code_block(block, band, style)):
            rows[block.y + y][block.x : block.x + block.width] = row
    return rows


def decode(data, width, height, depth, signed):
    """Rows of samples of a codestream that must have this shape. Raises CodestreamError."""
    codestream = Codestream(data)
    shape = codestream.width, codestream.height, codestream.depth, codestream.signed
    demand(shape == (width, height, depth, signed), "another shape")
    levels = resolutions(codestream)
    read_packets(codestream, levels)
    image = band_rows(levels[0].bands[0], codestream.block_style)
    for resolution in levels[1:]:
        image = join(image, *(band_rows(band, codestream.block_style) for band in resolution.bands))
    shift = 0 if signed else 2 ** (depth - 1)
    return [[sample + shift for sample in row] for row in image]
