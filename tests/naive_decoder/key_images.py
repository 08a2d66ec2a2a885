"""Key images: planes of their codestreams (KEY-2 to KEY-4, EXT-6)."""

from crc32c import crc32c
from integers import clamp
from jpeg2000.decoder import Codestream, CodestreamError, decode
from stream_error import StreamError, require


def decode_key_plane(stream, image, plane):
    """Rows of samples of a plane of a key image."""
    codestream, sample_crc = stream.codestreams[image, plane]
    geometry, depth = stream.geometry, stream.header.depth
    shape = (*geometry.plane_size(plane), depth if plane == 0 else depth + 1, plane > 0)
    try:
        markers = Codestream(codestream, *shape)
    except CodestreamError as error:
        raise StreamError("bad_top_image") from error
    try:
        rows = decode(markers)
    except CodestreamError as error:
        raise StreamError("bad_top_crc") from error
    lo, hi = geometry.interval(plane)
    if stream.header.lossy_keys:
        rows = [[clamp(sample, lo, hi) for sample in row] for row in rows]
    halves = b"".join((sample % 2**16).to_bytes(2, "little") for row in rows for sample in row)
    require(crc32c(halves) == sample_crc, "bad_top_crc")
    require(all(lo <= sample <= hi for row in rows for sample in row), "top_sample_range")
    return rows
