"""The width table of docs/rendering.md: its intervals give its bits, and are those of the values
that the clauses allow, of n * r those that a proof allows. Inputs and limits are read from CAM-3
and REC-3, nothing from the width table itself."""

import math
import re
from fractions import Fraction
from functools import cache
from itertools import product

from extremes import DISPARITIES, eighths, ends, interpolated_sums, negated, products, shifted, sums, union
from specification import RENDERING, read, rows_after, table_after
from widths import DEPTHS, evaluate, interval, needed_bits, table_violations

HEADING = "## 6"
DEEPEST = 12
BITS = re.compile(r"(\d+)(?: unsigned)?( \(n = 12\))?")


def quantities(text, n):
    """{row of the table: (least, greatest)} at depth n, in the order of the clauses."""
    return quantities_of_clauses(text[: text.index(HEADING)], n)  # the table is compared with them, never read


@cache
def quantities_of_clauses(text, n):
    inputs = {row[0]: row[1] for row in table_after(text, "**[CAM-3]**")}
    sides = intervals_in(inputs["frame_width, frame_height"])[0]
    places, distances = intervals_in(inputs["position: pu, pv, pz"])
    tan_half = intervals_in(inputs["tan_half"])[0]
    apertures = [int(value) for value in inputs["aperture"].split(", ")]
    gain, origin = limit(text, "abs(gain)"), limit(text, "abs(x0)")
    parallax = limit(text, "abs(dx) * (cols - 1)")
    u0, zu = ([end << 16 for end in span] for span in (places, distances))
    pixel = ends(a for side in range(sides[0], sides[1] + 1) for a in places_of_rays(side))
    low = (0, 2**12 - 1)
    # No ray is further from the middle of its frame, in sides of it, than in the largest.
    reach = max(Fraction(abs(a), side) for side in range(sides[0], sides[1] + 1) for a in places_of_rays(side))
    assert reach == Fraction(sides[1] - 1, sides[1])
    normal = component(sides[1], tan_half[1])
    reciprocals = ends((2**57 - 1) // nz for nz in (2**26, normal[1]))  # not outside (RAY-2)
    slopes = shifted(aside(normal), 29)
    scaled = union(products(zu, slopes), products(gain, slopes))
    picture = sums(origin, shifted(products(gain, slopes), 28))
    weights = view_weights(apertures)
    taps = sums(interpolated_sums((0, 2**n - 1), 256, (0, 1, 255)), (2**11, 2**11))
    colour = shifted(taps, 12)
    return {
        "a, b": pixel,
        "na_lo * a + nb_lo * b + n0_lo": sums(products(pixel, low), products(pixel, low), low),
        "n": normal,
        "r": reciprocals,
        "n * r": aside(normal),
        "sx, sy": slopes,
        "u0, v0": tuple(u0),
        "zu, zv": tuple(zu),
        "zu * sx, gain * sx": scaled,
        "U, V before their clamp": sums(u0, negated(shifted(products(zu, slopes), 28))),
        "xb, yb": picture,
        "x(c), y(r)": sums(picture, parallax),
        "x, y after their clamp": (0, (2**16 - 1) << 12),  # FIL-1: width and height
        "wr, wc": weights,
        "weight of a view": products(weights, weights),
        "sum of four taps": taps,
        "q": colour,
        "sum over views": tuple(2**16 * q + 2**19 for q in colour),  # weights sum to 2^16
        **geometry_quantities(),
        **surface_quantities(inputs, sums(picture, parallax)),
    }


def places_of_rays(side):
    """a of the first and the last pixel, and of the last cell (SRF-1), of a frame of `side` pixels."""
    return 1 - side, side - 1, min(8 * ((side - 1) // 4) + 4 - side, side - 1)


def surface_quantities(inputs, places):
    """Those of section 9: `places` of x(c) and y(r), and the views with a weight of SMP-1."""
    disparity = -(2**15), 2**15 - 1  # GEO-1
    focus = [end << 8 for end in intervals_in(inputs["focus"])[0]]
    pitch = int(intervals_in(inputs["row_pitch"])[0][1] * 2**8)
    rows = shifted(sums(products(disparity, (-pitch, pitch)), (2**7, 2**7)), 8)
    # A view with weight has abs(m * 2^8 - A) <= 255; Us is at most half a step outside the grid.
    steps = ends(
        (m << 12) - (place >> 4) for m in (0, 1) for place in range(-(2**15), 2**17)
        if abs((m << 8) - ((place + 2**7) >> 8)) <= 255
    )
    moved = union(products(disparity, steps), products(rows, steps))
    return {
        "focus, D - focus": union(focus, sums(disparity, negated(focus))),
        "E": disparity,
        "G": rows,
        "c * 2^12 - (Us >> 4)": steps,
        "E * (c * 2^12 - (Us >> 4))": moved,
        "x(c, E), y(r, E)": sums(places, shifted(moved, 8)),
    }


def geometry_quantities():
    """Those of section 8, from the grid's side (FIL-1), row_scale (EXT-2) and MOT-6."""
    side = 4096
    scaled = products(DISPARITIES, (1, 2**8))
    vector = eighths()
    across = products((-(side - 1), side - 1), (16, 16))
    down = products((-(side - 1), side - 1), (127, 127))
    along = sums(products(vector, across), products(vector, down))  # u * gy - v * gx likewise
    num = products(along, (512, 512))
    den = 1, across[1] ** 2 + down[1] ** 2
    return {
        "d * 2^(8 - disparity_precision)": scaled,
        "2 * abs(d * 2^(8 - disparity_precision)) + kc": (1, -2 * scaled[0] + side),
        "u, v": vector,
        "gx": across,
        "gy": down,
        "num": num,
        "den": den,
        "2 * abs(num) + den": (den[0], 2 * num[1] + den[1]),
        "u * gy - v * gx": along,
        "(u * gy - v * gx)^2": (0, along[1] ** 2),
        "D": (-(2**15), 2**15 - 1),
    }


def component(side, slope):
    """n: the bound, and what cameras all around reach in the corners of a frame. One component each
    of forward, right and down is a vector of length 1, so that n is no longer than
    (1, a * t, b * t); it is a sum of 1 + a + b numbers that fix() rounds by half of 2^-40."""
    corner = side - 1
    longest = 2**28 * math.sqrt(1 + 2 * (slope * corner / side) ** 2)
    rounding = (1 + 2 * corner) / 2 / 2**12
    bound = (math.floor(-longest - rounding), math.floor(longest + rounding))
    return union(bound, components(side, slope))


def aside(normal):
    """n * r where RAY-2 lets n through. With abs(n) <= 4 * n.z - 1 and n.z * r <= 2^57 - 1 it
    is at most 4 * (2^57 - 1) - r; r is least at the largest n.z whose 4 * n.z - 1 is an n. At
    larger n.z, n is 4 * n.z - 2 at most, and falls behind further."""
    bound = 4 * (2**57 - 1) - (2**57 - 1) // ((max(map(abs, normal)) + 1) // 4)
    return -bound, bound


def view_weights(apertures):
    """wc of SMP-1 at every A of a step, over all columns."""
    found = set()
    for aperture in apertures:
        k, steps = 8 - 2 * aperture, 2**aperture
        for place in range(2**k):
            columns = range(-steps + 1, steps + 1)
            row = [max(0, (steps << k) - abs((m << k) - place)) for m in columns]
            assert sum(row) == 256
            found.update(row)
    return ends(found)


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


def bits_violations(row):
    span = interval(row["interval"], DEEPEST)
    bits, at_depth = BITS.fullmatch(row["bits"]).groups()
    if needed_bits(*span) != int(bits):
        yield f"bits should be {needed_bits(*span)}, not {row['bits']}: the interval is {span}"
    if ("n" in row["interval"]) != bool(at_depth):
        yield "bits name a depth where, and only where, the interval depends on it"


def reach_violations(row, text):
    for n in DEPTHS if "n" in row["interval"] else [DEEPEST]:
        proved = interval(row["interval"], n)
        reached = quantities(text, n)[row["quantity"]]
        if proved != reached:
            yield f"at n = {n} values reach {list(reached)}, not {list(proved)}"
            return


def violations(root):
    text = read(root, RENDERING)

    def of_row(row):
        return [*bits_violations(row), *reach_violations(row, text)]

    rows, known = rows_after(text, HEADING), quantities(text, DEEPEST)
    yield from table_violations("frame widths", rows, known, of_row)
