"""What the quantities of section 11 can be: arithmetic of intervals where inputs are independent of
each other, else all inputs are tried. Nothing is read from the specification's width table."""

from functools import cache
from itertools import product

DISPARITIES = (-(2**12), 2**12 - 1)
SIGNS = (-1, 1)


def ends(values):
    values = list(values)
    return min(values), max(values)


def union(*intervals):
    return ends(end for interval in intervals for end in interval)


def sums(*intervals):
    return sum(lo for lo, _ in intervals), sum(hi for _, hi in intervals)


def products(a, b):
    return ends(x * y for x, y in product(a, b))


def shifted(interval, k):
    return interval[0] >> k, interval[1] >> k


def negated(interval):
    return -interval[1], -interval[0]


@cache
def quantities(n, plane):
    """{row of the table: (least, greatest)} at depth n, of plane 0 = Y or 1 = Co, Cg."""
    luma, chroma = sample_ranges(n)
    samples = (luma, chroma)[plane]
    bound = samples[1] - samples[0]
    counts = level_counts(n)
    biases = (-(2 ** (n + 1)), 2 ** (n + 1) - 1)
    unclamped = sums(union(*((-(c >> 1), c - 1 - (c >> 1)) for c in counts)), biases)
    residual = max(unclamped[0], -bound), min(unclamped[1], bound)
    reference = union(residual, samples)
    sums_of_taps = interpolated_sums(reference, 8, range(8))
    t = sums(luma, negated(shifted(chroma, 1)))
    upper_half = ends(c - (c >> 1) for c in range(chroma[0], chroma[1] + 1))
    most_vector = max(window << precision for window in range(128) for precision in range(4))
    return {
        "sample, parent P": samples,
        "residual bound M": (0, bound),
        "BISE value": (0, max(counts) - 1),
        "bias": biases,
        "residual before its clamp": unclamped,
        "residual, SRV reference": residual,
        "ref": reference,
        # At the top P is 0 and ref a key sample.
        "P + sign * ref": union(sums(samples, products(SIGNS, residual)), products(SIGNS, samples)),
        "A + residual": sums(samples, residual),
        "vector component": (-127, 127),
        "step * residual": products((1, 256), residual),
        "disparity": DISPARITIES,
        "explicit_x, explicit_y": (-(2**11), 2**11 - 1),
        "rk - r, ck - c": reference_offsets(),
        "d * row_scale * (rk - r)": scaled_disparities(),
        "vx, vy": (-most_vector, most_vector),
        "u": eighths(),
        "I": sums_of_taps,
        "I_first + I_second + 64": sums(sums_of_taps, sums_of_taps, (64, 64)),
        "t": t,
        "G before its clamp": sums(luma, upper_half),
        "B before its clamp": sums(t, negated(shifted(chroma, 1))),
        "R before its clamp": sums(t, upper_half),
        "image number": (0, most_images() - 1),
        "tile number": (0, most_tiles() - 1),
        "bit position in a tile record": (0, longest_record(n)),
    }


def sample_ranges(n):
    """Those of Y and of Co and Cg (COL-1): all colours at small depths, else those of extreme parts."""
    top = 2**n - 1
    parts = range(top + 1) if n < 6 else [0, 1, top - 1, top]
    y, co, cg = map(ends, zip(*(forward(*rgb) for rgb in product(parts, repeat=3))))
    assert co == cg
    return y, co


def forward(r, g, b):
    """COL-1."""
    co = r - b
    t = b + (co >> 1)
    cg = g - t
    return t + (cg >> 1), co, cg


def level_counts(n):
    """BISE-1 as far as TIL-8 allows: 2^k, 3 * 2^k and 5 * 2^k up to 4 * 2^n."""
    return [c for c in (b << k for b in (1, 3, 5) for k in range(n + 3)) if c <= 4 * 2**n]


def interpolated_sums(values, one, fractions):
    """Sums of four samples with weights of `fractions` of `one` (MOT-9); monotone in each sample."""
    return ends(
        (one - fy) * ((one - fx) * a + fx * b) + fy * ((one - fx) * c + fx * d)
        for fx, fy in product(fractions, repeat=2)
        for a, b, c, d in product(values, repeat=4)
    )


def longest_record(n):
    """Bits of the longest tile record (TIL-1, STP-1): every field at its longest, 8 x 8 blocks."""

    def bise(counts):
        return max(bise_bits(count, 64) for count in counts)

    masks = 2 * (16 + 16 * 4)
    vector_counts = [c for c in level_counts(12) if c <= 256]  # K of window 127
    vectors = 2 + 2 * (8 + 5) + 64 + 2 * bise(vector_counts)
    headers = 6 + 3 + 4 + 4 + 2 + 64 * (6 + 3 + n + 2)
    return 2 + 2 + masks + vectors + headers + 64 * bise(level_counts(n))


def bise_bits(count, values):
    """BISE-3."""
    n = 0
    while count % 2 == 0:
        count //= 2
        n += 1
    digits = {1: 0, 3: -(-8 * values // 5), 5: -(-7 * values // 3)}[count]
    return n * values + digits


def most_images():
    """The greatest number of images a tree can have (FIL-1, STR-3)."""
    return max(
        images(rows, cols, cluster)
        for rows, cols in product((1, 2, 4095, 4096), repeat=2)
        for cluster in product((1, 2, 3, 255), repeat=2)
        if cluster != (1, 1)
    )


def images(rows, cols, cluster):
    total = 0
    for _ in range(16):
        total += rows * cols
        rows, cols = -(-rows // cluster[0]), -(-cols // cluster[1])
    return total


def most_tiles():
    """The greatest number of tiles: blocks of 2 x 2, tiles of 16 x 16 samples, three planes, and
    motion tiles of 32 x 32, two planes (MOT-1)."""
    return most_images() * (3 * (65536 // 16) ** 2 + 2 * (65536 // 32) ** 2)


@cache
def reference_offsets():
    """rk - r for K0 and K1 of MOT-7, over rows of images and lengths of groups (STR-4, EXT-3)."""
    offsets = set()
    for length in (1, 2, 3, 254, 255):
        for count in {1, 2, length, length + 1, 2 * length - 1, 2 * length, 2 * length + 1,
                      3 * length, 3 * length + 1, 4096}:
            groups = -(-count // length)
            for begins in ([k * length for k in range(groups)],
                           [k * count // groups for k in range(groups)]):
                offsets.update(line_offsets([*begins, count]))
    return min(offsets), max(offsets)


def line_offsets(begins):
    """All rk - r of one row of groups that begin at these places, the end being the last."""
    groups = len(begins) - 1
    references = [b + (e - b - 1) // 2 for b, e in zip(begins, begins[1:])]
    for group in range(groups):
        for place in range(begins[group], begins[group + 1]):
            step = 1 if place >= references[group] else -1
            following = group + step if 0 <= group + step < groups else group - step
            if not 0 <= following < groups:
                following = group
            yield references[group] - place
            yield references[following] - place


def scaled_disparities():
    found = products(products(DISPARITIES, (-127, 127)), reference_offsets())
    assert all(-(2**28) <= x < 2**28 for x in sums(found, (0, 2**8)))  # rounded as well
    return found


@cache
def eighths():
    """u of MOT-9, also for planes of half the size."""
    found = set()
    for precision in range(4):
        most = 127 << precision
        for component in range(-most, most + 1):
            u = component * 2 ** (3 - precision)
            found.update((u, (u + 1) >> 1))
    return min(found), max(found)
