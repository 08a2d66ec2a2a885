"""What the quantities of section 11 can be, found by trying: all inputs where they are few, else
the ends of each input's interval. Nothing is read from the specification's width table."""

from functools import cache
from itertools import product

# From this depth on, inputs take the values at both ends of their intervals alone. Every formula
# is monotone in each input, which the depths below show.
MANY = 6


class Tried:
    """The extremes at one depth; Y first, then Co and Cg."""

    def __init__(self, n):
        self.n = n
        top = 2**n - 1
        colours = [self.forward(*rgb) for rgb in product(self.span(0, top), repeat=3)]
        self.samples = [self.ends(c[0] for c in colours), self.ends(c[2] for c in colours)]
        assert self.samples[1] == self.ends(c[1] for c in colours)
        self.bounds = [hi - lo for lo, hi in self.samples]

    def span(self, lo, hi):
        """The values of [lo, hi] to try."""
        if self.n < MANY or hi - lo < 4:
            return range(lo, hi + 1)
        return [lo, lo + 1, hi - 1, hi]

    @staticmethod
    def ends(values):
        values = list(values)
        return min(values), max(values)

    @staticmethod
    def forward(r, g, b):
        """COL-1."""
        co = r - b
        t = b + (co >> 1)
        cg = g - t
        return t + (cg >> 1), co, cg

    def level_counts(self):
        """BISE-1 as far as TIL-8 allows: 2^k, 3 * 2^k and 5 * 2^k up to 4 * 2^n."""
        counts = [base << k for base in (1, 3, 5) for k in range(self.n + 3)]
        return [count for count in counts if count <= 4 * 2**self.n]

    def biases(self):
        """n + 2 bits of two's complement."""
        return -(2 ** (self.n + 1)), 2 ** (self.n + 1) - 1

    def unclamped_residual(self):
        return self.ends(
            value - (count >> 1) + bias
            for count in self.level_counts()
            for value in self.span(0, count - 1)
            for bias in self.span(*self.biases())
        )

    def residual(self, plane):
        lo, hi = self.unclamped_residual()
        bound = self.bounds[plane]
        return max(lo, -bound), min(hi, bound)

    def reference(self, plane):
        return self.ends([*self.residual(plane), *self.samples[plane]])

    def stepped(self, plane):
        """STP-3 before its outer clamp: steps are 2^k and 3 * 2^k up to 256."""
        steps = [base << k for base in (1, 3) for k in range(9) if base << k <= 256]
        return self.ends(s * r for s in steps for r in self.span(*self.residual(plane)))

    def interpolated(self, plane):
        """I of MOT-9 at all fractions; monotone in each of the four samples."""
        values = self.reference(plane)
        return self.ends(
            (8 - fy) * ((8 - fx) * a + fx * b) + fy * ((8 - fx) * c + fx * d)
            for fx, fy in product(range(8), repeat=2)
            for a, b, c, d in product(values, repeat=4)
        )

    def two_interpolated(self, plane):
        ends = self.interpolated(plane)
        return self.ends(first + second + 64 for first, second in product(ends, repeat=2))

    def phased(self, plane):
        """P + sign * ref: below the top with residuals, at the top with P = 0 and key samples."""
        below = product(self.span(*self.samples[plane]), self.span(*self.residual(plane)))
        sums = [p + sign * ref for p, ref in below for sign in (1, -1)]
        return self.ends([*sums, *self.samples[plane], *(-x for x in self.samples[plane])])

    def corrected(self, plane):
        pairs = product(self.span(*self.samples[plane]), self.span(*self.residual(plane)))
        return self.ends(a + residual for a, residual in pairs)

    def t_values(self):
        y, chroma = self.span(*self.samples[0]), self.span(*self.samples[1])
        return [a - (cg >> 1) for a, cg in product(y, chroma)]

    def green(self):
        y, chroma = self.span(*self.samples[0]), self.span(*self.samples[1])
        return self.ends(cg + a - (cg >> 1) for a, cg in product(y, chroma))

    def blue(self):
        chroma = self.span(*self.samples[1])
        return self.ends(t - (co >> 1) for t, co in product(set(self.t_values()), chroma))

    def red(self):
        chroma = self.span(*self.samples[1])
        return self.ends(t - (co >> 1) + co for t, co in product(set(self.t_values()), chroma))

    def longest_record(self):
        """Bits of the longest tile record (TIL-1, STP-1): every field at its longest, 8 x 8 blocks."""

        def bise(counts, values):
            return max(bise_bits(count, values) for count in counts)

        masks = 2 * (16 + 16 * 4)
        vector_counts = [c for c in Tried(12).level_counts() if c <= 256]  # K of window 127
        vectors = 2 + 2 * (8 + 5) + 64 + 2 * bise(vector_counts, 64)
        headers = 6 + 3 + 4 + 4 + 2 + 64 * (6 + 3 + self.n + 2)
        return 2 + 2 + masks + vectors + headers + 64 * bise(self.level_counts(), 64)


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


DISPARITIES = (-(2**12), 2**12 - 1)


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


@cache
def scaled_disparities():
    ends = [
        d * scale * offset
        for d in DISPARITIES
        for scale in (-127, 127)
        for offset in reference_offsets()
    ]
    rounded = [x + 2**8 for x in ends]
    assert all(-(2**28) <= x < 2**28 for x in [*ends, *rounded])
    return min(ends), max(ends)


@cache
def vector_components():
    """MOT-8: vectors clamped to V, for every window and precision."""
    most = max(window << precision for window in range(128) for precision in range(4))
    return -most, most


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
