"""From a codestream to samples (KEY-4, EXT-6)."""

from integers import clamp

from .code_block import decode_code_block
from .codestream_error import CodestreamError
from .markers import Codestream
from .packets import read_packets
from .subbands import resolutions
from .wavelet import join

__all__ = ["Codestream", "CodestreamError", "decode"]


def band_rows(band, style):
    """Rows of coefficients of a subband."""
    rows = [[0] * band.width for _ in range(band.height)]
    for block in band.blocks:
        for y, row in enumerate(decode_code_block(block, band, style)):
            rows[block.y + y][block.x : block.x + block.width] = row
    return rows


def clamp_samples(rows, depth, signed):
    """Samples in the interval that SIZ states."""
    lo, hi = (-(2 ** (depth - 1)), 2 ** (depth - 1) - 1) if signed else (0, 2**depth - 1)
    return [[clamp(sample, lo, hi) for sample in row] for row in rows]


def decode(codestream):
    """Rows of samples of a Codestream, whose markers are good. Raises CodestreamError."""
    levels = resolutions(codestream)
    read_packets(codestream, levels)
    image = band_rows(levels[0].bands[0], codestream.block_style)
    for resolution in levels[1:]:
        image = join(image, *(band_rows(band, codestream.block_style) for band in resolution.bands))
    depth, signed = codestream.depth, codestream.signed
    shift = 0 if signed else 2 ** (depth - 1)
    return clamp_samples([[sample + shift for sample in row] for row in image], depth, signed)
