"""The width table of docs/rendering.md: its intervals give its bits, and are those of the values
that the clauses allow, of n * r those that a proof allows. Inputs and limits are read from CAM-3
and REC-3, nothing from the width table itself."""

import math
import re
from functools import cache
from itertools import product

from specification import RENDERING, read, rows_after, table_after
from widths import DEPTHS, evaluate, interval, needed_bits, table_violations

HEADING = "## 6"
DEEPEST = 12
BITS = re.compile(r"(\d+)(?: unsigned)?( \(n = 12\))?")


def ends(values):
    values = list(values)
    return min(values), max(values)


def products(a, b):
    return ends(x * y for x, y in product(a, b))


def sums(*intervals):
    return sum(lo for lo, _ in intervals), sum(hi for _, hi in intervals)


def shifted(span, k):
    return span[0] >> k, span[1] >> k


def negated(span):
    return -span[1], -span[0]


class Frame:
    """The extremes of every quantity, in the order of the clauses."""

    def __init__(self, text):
        inputs = {row[0]: row[1] for row in table_after(text, "**[CAM-3]**")}
        self.side = intervals_in(inputs["frame_width, frame_height"])[0]
        places, distances = intervals_in(inputs["position: pu, pv, pz"])
        self.tan_half = intervals_in(inputs["tan_half"])[0]
        self.apertures = [int(value) for value in inputs["aperture"].split(", ")]
        self.gain = limit(text, "abs(gain)")
        self.origin = limit(text, "abs(x0)")
        self.parallax = limit(text, "abs(dx) * (cols - 1)")
        self.u0 = tuple(end << 16 for end in places)
        self.zu = tuple(end << 16 for end in distances)

    def pixel(self):
        """a and b: over the first and the last pixel of frames of every size."""
        least, most = self.side
        return ends(2 * i + 1 - side for side in range(least, most + 1) for i in (0, side - 1))

    def low_part(self):
        pixel, low = self.pixel(), (0, 2**12 - 1)
        return sums(products(pixel, low), products(pixel, low), low)

    def component(self):
        """n: the bound, and what cameras all around reach in the corners of a frame. Of forward,
        right and down one component each is a vector of length 1, so that n is no longer than
        (1, a * t, b * t); it is a sum of 1 + a + b numbers that fix() rounds by half of 2^-40."""
        side, slope = self.side[1], self.tan_half[1]
        corner = side - 1
        longest = 2**28 * math.sqrt(1 + 2 * (slope * corner / side) ** 2)
        rounding = (1 + 2 * corner) / 2 / 2**12
        bound = (math.floor(-longest - rounding), math.floor(longest + rounding))
        return ends([*bound, *components(side, slope)])

    def forward_part(self):
        """n.z of pixels that are not outside (RAY-2)."""
        return 2**26, self.component()[1]

    def reciprocals(self):
        return ends((2**57 - 1) // nz for nz in self.forward_part())

    def aside(self):
        """n * r where RAY-2 lets n through. With abs(n) <= 4 * n.z - 1 and n.z * r <= 2^57 - 1 it
        is at most 4 * (2^57 - 1) - r; r is least at the largest n.z whose 4 * n.z - 1 is an n. At
        larger n.z, n is 4 * n.z - 2 at most, and falls behind further."""
        longest = max(map(abs, self.component()))
        bound = 4 * (2**57 - 1) - (2**57 - 1) // ((longest + 1) // 4)
        return -bound, bound

    def slopes(self):
        return shifted(self.aside(), 29)

    def scaled_slope(self):
        """zu * sx and gain * sx."""
        return ends([*products(self.zu, self.slopes()), *products(self.gain, self.slopes())])

    def place(self):
        return sums(self.u0, negated(shifted(products(self.zu, self.slopes()), 28)))

    def picture(self):
        return sums(self.origin, shifted(products(self.gain, self.slopes()), 28))

    def picture_of_view(self):
        return sums(self.picture(), self.parallax)

    def clamped(self):
        return 0, (2**16 - 1) << 12  # FIL-1: width and height

    def weights(self):
        """wc of SMP-1 at every A of a step, over all columns."""
        found = set()
        for aperture in self.apertures:
            k = 8 - 2 * aperture
            steps = 2**aperture
            for place in range(2**k):
                columns = range(-steps + 1, steps + 1)
                row = [max(0, (steps << k) - abs((m << k) - place)) for m in columns]
                assert sum(row) == 256
                found.update(row)
        return ends(found)

    def taps(self, n):
        fractions, samples = (0, 1, 255), (0, 2**n - 1)
        return ends(
            (256 - fy) * ((256 - fx) * p[0] + fx * p[1])
            + fy * ((256 - fx) * p[2] + fx * p[3])
            + 2**11
            for fx, fy in product(fractions, repeat=2)
            for p in product(samples, repeat=4)
        )

    def view_colour(self, n):
        return shifted(self.taps(n), 12)

    def sum_of_views(self, n):
        """The weights of all views are 2^16 in sum."""
        return tuple(2**16 * q + 2**19 for q in self.view_colour(n))


@cache
def components(side, tan_half):
    """n of RAY-1 in the corners of frames of this side, for cameras all around."""
    step = tan_half / side
    corner = side - 1
    found = []
    for degrees in product(range(-88, 89, 4), repeat=2):
        axes = list(zip(*pose(*map(math.radians, degrees))))
        for a, b in product((-corner, corner), repeat=2):
            found.extend(direction(f, r * step, d * step, a, b) for f, r, d in axes)
    return ends(found)


def pose(turn, tilt):
    """CAM-4 of a camera that looks this far aside and down."""
    forward = (math.sin(turn) * math.cos(tilt), math.sin(tilt), math.cos(turn) * math.cos(tilt))
    h = math.hypot(forward[0], forward[2])
    right = (forward[2] / h, 0.0, -forward[0] / h)
    down = (
        forward[1] * right[2],
        forward[2] * right[0] - forward[0] * right[2],
        -forward[1] * right[0],
    )
    return forward, right, down


def direction(forward, right, down, a, b):
    """RAY-1 of one component."""
    (h0, l0), (ha, la), (hb, lb) = (
        divmod(math.floor(math.ldexp(v, 40) + 0.5), 4096) for v in (forward, right, down)
    )
    return h0 + a * ha + b * hb + ((l0 + a * la + b * lb) >> 12)


def intervals_in(cell):
    """The intervals [lo, hi] that a cell of CAM-3 names."""
    found = re.findall(r"\[([^,\]]+), ([^,\]]+)\]", cell)
    return [(evaluate(lo, DEEPEST), evaluate(hi, DEEPEST)) for lo, hi in found]


def limit(text, quantity):
    """[-L, L] where REC-3 says quantity <= L."""
    clause = text[text.index("**[REC-3]**") :]
    most = evaluate(re.search(re.escape(quantity) + r" <= ([\d^]+)", clause).group(1), DEEPEST)
    return -most, most


# Each row of the table: (least, greatest) at a depth.
QUANTITIES = {
    "a, b": lambda frame, n: frame.pixel(),
    "na_lo * a + nb_lo * b + n0_lo": lambda frame, n: frame.low_part(),
    "n": lambda frame, n: frame.component(),
    "r": lambda frame, n: frame.reciprocals(),
    "n * r": lambda frame, n: frame.aside(),
    "sx, sy": lambda frame, n: frame.slopes(),
    "u0, v0": lambda frame, n: frame.u0,
    "zu, zv": lambda frame, n: frame.zu,
    "zu * sx, gain * sx": lambda frame, n: frame.scaled_slope(),
    "U, V before their clamp": lambda frame, n: frame.place(),
    "xb, yb": lambda frame, n: frame.picture(),
    "x(c), y(r)": lambda frame, n: frame.picture_of_view(),
    "x, y after their clamp": lambda frame, n: frame.clamped(),
    "wr, wc": lambda frame, n: frame.weights(),
    "weight of a view": lambda frame, n: products(frame.weights(), frame.weights()),
    "sum of four taps": lambda frame, n: frame.taps(n),
    "q": lambda frame, n: frame.view_colour(n),
    "sum over views": lambda frame, n: frame.sum_of_views(n),
}


def bits_violations(row):
    span = interval(row["interval"], DEEPEST)
    bits, at_depth = BITS.fullmatch(row["bits"]).groups()
    if needed_bits(*span) != int(bits):
        yield f"bits should be {needed_bits(*span)}, not {row['bits']}: the interval is {span}"
    if ("n" in row["interval"]) != bool(at_depth):
        yield "bits name a depth where, and only where, the interval depends on it"


def reach_violations(row, frame):
    for n in DEPTHS if "n" in row["interval"] else [DEEPEST]:
        proved = interval(row["interval"], n)
        reached = QUANTITIES[row["quantity"]](frame, n)
        if proved != reached:
            yield f"at n = {n} values reach {list(reached)}, not {list(proved)}"
            return


def violations(root):
    text = read(root, RENDERING)
    frame = Frame(text)

    def of_row(row):
        return [*bits_violations(row), *reach_violations(row, frame)]

    yield from table_violations("frame widths", rows_after(text, HEADING), QUANTITIES, of_row)
