"""Rays: where a ray of a frame meets the views and their pictures (section 3 of docs/rendering.md)."""

from integers import clamp


class Ray:
    """The ray with the numbers (a, b) in a frame of a record.

    Attributes, by clause: n (RAY-1); w, sx, sy (RAY-2); U, V before their clamp (RAY-3); xb, yb (RAY-4);
    nearest = (row, col) (RAY-5). `outside` says whether it is outside; the attributes of clauses after the one
    that found this are missing.
    """

    def __init__(self, record, a, b):
        self.record, self.a, self.b, self.outside = record, a, b, True
        self.n = tuple(self._direction(axis) for axis in "xyz")
        found = slopes(*self.n)
        if found is None:
            return
        self.w, self.sx, self.sy = found
        self.U = record["u0"] - shift(record["zu"], self.sx)
        self.V = record["v0"] - shift(record["zv"], self.sy)
        if misses(self.U, record["cols"]) or misses(self.V, record["rows"]):
            return
        self.xb = record["x0"] + shift(record["gain"], self.sx)
        self.yb = record["y0"] + shift(record["gain"], self.sy)
        u, v = self.on_grid()
        row, col = self.nearest = nearest_view(v), nearest_view(u)
        self.outside = not (in_picture(self.x(col), record["width"]) and in_picture(self.y(row), record["height"]))

    def _direction(self, axis):
        """RAY-1."""
        fields = [(self.record[f"{v}_hi.{axis}"], self.record[f"{v}_lo.{axis}"]) for v in ("n0", "na", "nb")]
        return direction(*fields, self.a, self.b)

    def on_grid(self):
        """(U, V) clamped to the grid of views (RAY-3)."""
        record = self.record
        return in_grid(self.U, record["cols"]), in_grid(self.V, record["rows"])

    def x(self, col, displacement=0):
        """x(c), or x(c, E) (RAY-4, SRF-2)."""
        place = self.xb + self.record["dx"] * (col - self.record["c0"])
        return place + moved(displacement, col, near_grid(self.U, self.record["cols"]))

    def y(self, row, displacement=0):
        """y(r), or y(r, E) (RAY-4, SRF-2)."""
        place = self.yb + self.record["dy"] * (row - self.record["r0"])
        down = down_a_row(displacement, self.record["pitch"])
        return place + moved(down, row, near_grid(self.V, self.record["rows"]))


def ray_of_pixel(record, i, j):
    """The ray of a pixel of the frame."""
    return Ray(record, 2 * i + 1 - record["frame_width"], 2 * j + 1 - record["frame_height"])


def direction(n0, na, nb, a, b):
    """A component of n, given (hi, lo) of those of n0, na and nb (RAY-1)."""
    high, low = (v0 + a * va + b * vb for v0, va, vb in zip(n0, na, nb))
    return high + (low >> 12)


def slopes(nx, ny, nz):
    """(w, sx, sy), or None of a ray that is outside (RAY-2)."""
    if nz < 2**26 or abs(nx) >> 2 >= nz or abs(ny) >> 2 >= nz:
        return None
    w = (2**57 - 1) // nz
    return w, nx * w >> 29, ny * w >> 29


def shift(factor, slope):
    """zu, zv or gain times a slope (RAY-3, RAY-4)."""
    return factor * slope >> 28


def misses(place, count):
    """Whether U or V is more than half a step away from a grid of several views (RAY-3)."""
    return count > 1 and not -(2**15) <= place <= (count - 1) * 2**16 + 2**15


def in_grid(place, count):
    """U or V clamped to the grid (RAY-3)."""
    return clamp(place, 0, (count - 1) * 2**16)


def nearest_view(place):
    """The column or row of the nearest view, given U or V in the grid (RAY-5)."""
    return (place + 2**15) >> 16


def in_picture(place, size):
    """Whether x(c) or y(r) is in a picture of this width or height (RAY-5)."""
    return -(2**11) <= place <= size * 2**12 - 2**11 - 1


def near_grid(place, count):
    """Us or Vs (SRF-2)."""
    return clamp(place, -(2**15), (count - 1) * 2**16 + 2**15)


def down_a_row(displacement, pitch):
    """G (SRF-2)."""
    return (displacement * pitch + 2**7) >> 8


def moved(displacement, view, place):
    """x(c, E) - x(c), given Us; or y(r, E) - y(r), given G and Vs (SRF-2)."""
    return displacement * (view * 2**12 - (place >> 4)) >> 8
