"""From Y, Co, Cg to R, G, B (section 6)."""

from integers import clamp


def to_rgb(y, co, cg, depth):
    """COL-2."""
    t = y - (cg >> 1)
    g = cg + t
    b = t - (co >> 1)
    r = b + co
    return tuple(clamp(sample, 0, 2**depth - 1) for sample in (r, g, b))
