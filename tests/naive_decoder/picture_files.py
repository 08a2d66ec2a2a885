"""Views as bytes and as files."""

from struct import pack


def samples(view, order, depth):
    """R, G, B pixel by pixel; one byte a sample at depth 8, else two, in the byte order < or >."""
    numbers = [sample for row in view for pixel in row for sample in pixel]
    return pack(f"{order}{len(numbers)}{'B' if depth == 8 else 'H'}", *numbers)


def raw_bytes(view, depth):
    """Pixels row by row, R, G, B; little-endian."""
    return samples(view, "<", depth)


def ppm_bytes(view, depth):
    """A binary PPM file."""
    head = f"P6\n{len(view[0])} {len(view)}\n{2**depth - 1}\n".encode()
    return head + samples(view, ">", depth)
