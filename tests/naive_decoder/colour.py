"""From Y, Co, Cg to R, G, B (section 6)."""

from integers import clamp


def to_rgb(y, co, cg, depth):
    """COL-2."""
    t = y - (cg >> 1)
    g = cg + t
    b = t - (co >> 1)
    r = b + co
    greatest = 2**depth - 1
    return clamp(r, 0, greatest), clamp(g, 0, greatest), clamp(b, 0, greatest)
