"""The least codestream."""

from jpeg2000.markers import COD, EOC, QCD, SIZ, SOC, SOD, SOT


def u(size, *values):
    """Big-endian integers."""
    return b"".join(value.to_bytes(size, "big") for value in values)


def segment(marker, content):
    """A marker segment."""
    return u(2, marker, len(content) + 2) + content


def encode_nothing(width, height, depth, signed, decompositions=2):
    """A codestream whose packets are all empty: all coefficients are 0."""
    size = u(4, width, height, 0, 0, width, height, 0, 0)
    depth_byte = depth - 1 + (128 if signed else 0)
    head = u(2, SOC) + segment(SIZ, u(2, 0) + size + u(2, 1) + u(1, depth_byte, 1, 1))
    head += segment(COD, u(1, 0, 0) + u(2, 1) + u(1, 0, decompositions, 4, 4, 0, 1))
    exponents = [depth] + [depth + 1, depth + 1, depth + 2] * decompositions
    head += segment(QCD, u(1, 2 * 32, *(8 * exponent for exponent in exponents)))
    packets = bytes(decompositions + 1)
    tile_part = segment(SOT, u(2, 0) + u(4, 12 + 2 + len(packets)) + u(1, 0, 1))
    return head + tile_part + u(2, SOD) + packets + u(2, EOC)
