"""Whole views: planes block by block, then colours (DEC-7, COL-3)."""

from colour import to_rgb


def decode_plane(decoder, row, col, plane, level=0):
    """Rows of samples of a plane of a view."""
    geometry = decoder.stream.geometry
    width, height = geometry.plane_size(plane)
    cols, rows = geometry.blocks(plane)
    side = geometry.block
    samples = [[0] * width for _ in range(height)]
    for block_y in range(rows):
        for block_x in range(cols):
            block = decoder.decode(row, col, plane, block_x, block_y, level)[-1].sample
            for y in range(block_y * side, min((block_y + 1) * side, height)):
                part = block[y - block_y * side][: width - block_x * side]
                samples[y][block_x * side : block_x * side + len(part)] = part
    return samples


def decode_view(decoder, row, col, level=0):
    """Rows of pixels (R, G, B) of a view."""
    header = decoder.stream.header
    luma, co, cg = (decode_plane(decoder, row, col, plane, level) for plane in range(3))
    shift = 1 if header.chroma_format == 0 else 0
    return [
        [
            to_rgb(luma[y][x], co[y >> shift][x >> shift], cg[y >> shift][x >> shift], header.depth)
            for x in range(header.width)
        ]
        for y in range(header.height)
    ]
