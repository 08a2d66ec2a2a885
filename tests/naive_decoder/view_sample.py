"""What one view gives to a sample of a frame (SMP-2)."""

from camera import FILTERS
from integers import clamp


class ViewSample:
    """The pixels that a ray reads in a view at the place (x, y), in 2^-12 pixels.

    xi, fx, yi, fy are those of SMP-2, with fx = fy = 0 for the filters nearest and views; taps is a list of
    (column, row, weight) without weights of 0, which sum to 65536.
    """

    def __init__(self, record, x, y):
        fine = FILTERS[record["filter"]] == "quadrilinear"
        self.xi, self.fx = part_of(x, record["width"], fine)
        self.yi, self.fy = part_of(y, record["height"], fine)
        self.taps = [
            (self.xi + right, self.yi + down, weight_x * weight_y)
            for down, weight_y in ((0, 256 - self.fy), (1, self.fy))
            for right, weight_x in ((0, 256 - self.fx), (1, self.fx))
            if weight_x * weight_y > 0
        ]

    def q(self, pixels):
        """q of R, G and B, given (R, G, B) for each tap: of a single one, 16 times its samples."""
        sums = [sum(tap[2] * value for tap, value in zip(self.taps, values)) for values in zip(*pixels)]
        return [(total + 2**11) >> 12 for total in sums]


def part_of(place, size, fine):
    """(xi, fx) of a place along one axis: `fine` between two pixels, else the nearest one."""
    place = clamp(place, 0, (size - 1) * 2**12)
    return divmod((place + 8) >> 4, 256) if fine else ((place + 2**11) >> 12, 0)
