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
        nx, ny, nz = self.n
        if nz < 2**26 or abs(nx) >> 2 >= nz or abs(ny) >> 2 >= nz:
            return
        self.w = (2**57 - 1) // nz
        self.sx, self.sy = nx * self.w >> 29, ny * self.w >> 29
        self.U = record["u0"] - (record["zu"] * self.sx >> 28)
        self.V = record["v0"] - (record["zv"] * self.sy >> 28)
        if misses(self.U, record["cols"]) or misses(self.V, record["rows"]):
            return
        self.xb = record["x0"] + (record["gain"] * self.sx >> 28)
        self.yb = record["y0"] + (record["gain"] * self.sy >> 28)
        u, v = self.on_grid()
        row, col = self.nearest = (v + 2**15) >> 16, (u + 2**15) >> 16
        in_x = -(2**11) <= self.x(col) <= record["width"] * 2**12 - 2**11 - 1
        in_y = -(2**11) <= self.y(row) <= record["height"] * 2**12 - 2**11 - 1
        self.outside = not (in_x and in_y)

    def _direction(self, axis):
        """RAY-1."""
        fields = [(self.record[f"{v}_hi.{axis}"], self.record[f"{v}_lo.{axis}"]) for v in ("n0", "na", "nb")]
        high, low = (n0 + self.a * na + self.b * nb for n0, na, nb in zip(*fields))
        return high + (low >> 12)

    def on_grid(self):
        """(U, V) clamped to the grid of views (RAY-3)."""
        record = self.record
        return clamp(self.U, 0, (record["cols"] - 1) * 2**16), clamp(self.V, 0, (record["rows"] - 1) * 2**16)

    def x(self, col, displacement=0):
        """x(c), or x(c, E) (RAY-4, SRF-2)."""
        place = self.xb + self.record["dx"] * (col - self.record["c0"])
        return place + (displacement * (col * 2**12 - (near_grid(self.U, self.record["cols"]) >> 4)) >> 8)

    def y(self, row, displacement=0):
        """y(r), or y(r, E) (RAY-4, SRF-2)."""
        place = self.yb + self.record["dy"] * (row - self.record["r0"])
        down = (displacement * self.record["pitch"] + 2**7) >> 8
        return place + (down * (row * 2**12 - (near_grid(self.V, self.record["rows"]) >> 4)) >> 8)


def ray_of_pixel(record, i, j):
    """The ray of a pixel of the frame."""
    return Ray(record, 2 * i + 1 - record["frame_width"], 2 * j + 1 - record["frame_height"])


def misses(place, count):
    """Whether U or V is more than half a step away from a grid of several views (RAY-3)."""
    return count > 1 and not -(2**15) <= place <= (count - 1) * 2**16 + 2**15


def near_grid(place, count):
    """Us or Vs (SRF-2)."""
    return clamp(place, -(2**15), (count - 1) * 2**16 + 2**15)
