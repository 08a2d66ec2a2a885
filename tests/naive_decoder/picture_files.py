"""Views as bytes and as files."""


def raw_bytes(view, depth):
    """Pixels row by row, R, G, B; one byte a sample at depth 8, else two, little-endian."""
    size = 1 if depth == 8 else 2
    return b"".join(sample.to_bytes(size, "little") for row in view for pixel in row for sample in pixel)


def ppm_bytes(view, depth):
    """A binary PPM file."""
    size = 1 if depth == 8 else 2
    head = f"P6\n{len(view[0])} {len(view)}\n{2**depth - 1}\n".encode()
    return head + b"".join(sample.to_bytes(size, "big") for row in view for pixel in row for sample in pixel)
