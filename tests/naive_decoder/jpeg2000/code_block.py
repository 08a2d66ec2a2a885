"""Coding passes of a code-block: from codeword segments to coefficients (T.800 annex D, EXT-6)."""

from functools import cache

from .codestream_error import demand
from .mq_decoder import MqDecoder, RawBits
from .packets import BYPASS, FIRST_BYPASS_PASS, TERMINATE_ALL

RESET, CAUSAL, SEGMENTATION_SYMBOLS = 2, 8, 32  # code-block styles
STRIPE = 4
RUN_LENGTH, UNIFORM = 17, 18
FIRST_SIGN, FIRST_MAGNITUDE = 9, 14


def fresh_contexts():
    """[state, more probable symbol] of the 19 contexts (T.800 table D.7)."""
    contexts = [[0, 0] for _ in range(19)]
    contexts[0], contexts[RUN_LENGTH], contexts[UNIFORM] = [4, 0], [3, 0], [46, 0]
    return contexts


@cache
def significance_context(kind, across, down, diagonal):
    """The context of a significance decision by significant neighbours (T.800 table D.1)."""
    if kind == "HH":
        if diagonal >= 3:
            return 8
        if diagonal == 2:
            return 7 if across + down >= 1 else 6
        return (3 if diagonal == 1 else 0) + min(across + down, 2)
    if kind == "HL":
        across, down = down, across
    if across == 2:
        return 8
    if across == 1:
        return 7 if down >= 1 else 6 if diagonal >= 1 else 5
    return 2 + down if down >= 1 else min(diagonal, 2)


def sign_context(across, down):
    """(context, flip) of a sign decision by sums of neighbours' signs in [-1, 1] (T.800 table D.3)."""
    flip = 1 if across < 0 or (across == 0 and down < 0) else 0
    if flip:
        across, down = -across, -down
    if across == 0:
        return FIRST_SIGN + down, flip
    return FIRST_SIGN + 3 + down, flip


class CodeBlockDecoder:
    """The state of the coefficients of one code-block while its passes are decoded."""

    def __init__(self, block, kind, style):
        self.kind, self.style = kind, style
        self.magnitude = [[0] * block.width for _ in range(block.height)]
        # 1, -1, or 0 where not significant; coefficient (x, y) is sign[y + 1][x + 1], with a border of 0.
        self.sign = [[0] * (block.width + 2) for _ in range(block.height + 2)]
        # Counts the significant neighbours: left and right, above and below, diagonal; has the same border.
        self.near = [[[0, 0, 0] for _ in row] for row in self.sign]
        self.lowest = [[0] * block.width for _ in range(block.height)]  # b of EXT-6
        self.refined = set()
        self.visited = set()
        self.contexts = fresh_contexts()
        # In the order of T.800 D.1: stripes of four rows, column by column.
        stripes = [range(top, min(top + STRIPE, block.height)) for top in range(0, block.height, STRIPE)]
        self.columns = [(x, rows) for rows in stripes for x in range(block.width)]
        self.places = [(x, y) for x, rows in self.columns for y in rows]

    def run(self, segments, plane):
        """Decodes all passes; the first is the cleanup pass of bit-plane `plane`."""
        number = 0
        for passes, data, _ in segments:
            raw = self._is_raw(number)
            self.mq, self.raw = (None, RawBits(data)) if raw else (MqDecoder(data), None)
            for _ in range(passes):
                kind = (number + 2) % 3
                self.plane = plane - (number + 2) // 3
                demand(self.plane >= 0, "more passes than bit-planes")
                (self._significance_pass, self._refinement_pass, self._cleanup_pass)[kind]()
                if self.style & RESET:
                    self.contexts = fresh_contexts()
                number += 1

    def signs(self):
        """Rows of signs, without the border."""
        return [row[1:-1] for row in self.sign[1:-1]]

    def _is_raw(self, number):
        return self.style & BYPASS and number >= FIRST_BYPASS_PASS and number % 3 != 0

    def _decide(self, context):
        return self.raw.bit() if self.raw else self.mq.decode(self.contexts, context)

    def _become_significant(self, x, y):
        if self.raw:
            negative = self.raw.bit()
        else:
            unseen = self.style & CAUSAL and y % STRIPE == STRIPE - 1
            across = self.sign[y + 1][x] + self.sign[y + 1][x + 2]
            down = self.sign[y][x + 1] + (0 if unseen else self.sign[y + 2][x + 1])
            context, flip = sign_context(max(-1, min(1, across)), max(-1, min(1, down)))
            negative = self.mq.decode(self.contexts, context) ^ flip
        self.sign[y + 1][x + 1] = -1 if negative else 1
        self.magnitude[y][x] = 2**self.plane
        above, level, below = self.near[y : y + 3]
        level[x][0] += 1
        level[x + 2][0] += 1
        for row in [below] if self.style & CAUSAL and y % STRIPE == 0 else [above, below]:
            row[x][2] += 1
            row[x + 1][1] += 1
            row[x + 2][2] += 1

    def _significance_pass(self):
        self.visited = set()
        for x, y in self.places:
            if self.sign[y + 1][x + 1] == 0 and any(self.near[y + 1][x + 1]):
                self._code_significance(x, y)
                self.visited.add((x, y))

    def _code_significance(self, x, y):
        self.lowest[y][x] = self.plane
        if self._decide(significance_context(self.kind, *self.near[y + 1][x + 1])):
            self._become_significant(x, y)

    def _refinement_pass(self):
        for x, y in self.places:
            if self.sign[y + 1][x + 1] == 0 or (x, y) in self.visited:
                continue
            context = FIRST_MAGNITUDE + 2
            if (x, y) not in self.refined:
                context = FIRST_MAGNITUDE + any(self.near[y + 1][x + 1])
            self.refined.add((x, y))
            self.lowest[y][x] = self.plane
            self.magnitude[y][x] += self._decide(context) * 2**self.plane

    def _cleanup_pass(self):
        for x, rows in self.columns:
            self._cleanup_column(x, rows)
        self.visited = set()
        if self.style & SEGMENTATION_SYMBOLS:
            symbols = [self.mq.decode(self.contexts, UNIFORM) for _ in range(4)]
            demand(symbols == [1, 0, 1, 0], "segmentation symbols")

    def _cleanup_column(self, x, rows):
        if len(rows) == STRIPE and all(self._is_quiet(x, y) for y in rows):
            for y in rows:
                self.lowest[y][x] = self.plane
            if self.mq.decode(self.contexts, RUN_LENGTH) == 0:
                return
            run = 2 * self.mq.decode(self.contexts, UNIFORM)
            run += self.mq.decode(self.contexts, UNIFORM)
            self._become_significant(x, rows[run])
            rows = rows[run + 1 :]
        for y in rows:
            if self.sign[y + 1][x + 1] == 0 and (x, y) not in self.visited:
                self._code_significance(x, y)

    def _is_quiet(self, x, y):
        return self.sign[y + 1][x + 1] == 0 and not any(self.near[y + 1][x + 1])


def reconstructed(sign, magnitude, lowest):
    """The coefficient of a sign, 0 where not significant, and a magnitude known down to plane `lowest` (EXT-6)."""
    return sign * (magnitude + 2**lowest // 2)


def decode_code_block(block, band, style):
    """Rows of wavelet coefficients of a code-block."""
    if not block.segments:
        return [[0] * block.width for _ in range(block.height)]
    decoder = CodeBlockDecoder(block, band.kind, style)
    decoder.run(block.segments, band.planes - 1 - block.missing_planes)
    return [
        [reconstructed(*coefficient) for coefficient in zip(*rows)]
        for rows in zip(decoder.signs(), decoder.magnitude, decoder.lowest)
    ]
