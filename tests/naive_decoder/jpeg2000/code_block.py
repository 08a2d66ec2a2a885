"""Coding passes of a code-block: from codeword segments to coefficients (T.800 annex D, EXT-6)."""

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
        self.width, self.height = block.width, block.height
        self.magnitude = [[0] * block.width for _ in range(block.height)]
        self.nothing = [0] * (block.width + 2)
        # 1, -1, or 0 where not significant; coefficient (x, y) is sign[y + 1][x + 1], with a border of 0.
        self.sign = [list(self.nothing) for _ in range(block.height + 2)]
        self.lowest = [[0] * block.width for _ in range(block.height)]  # b of EXT-6
        self.refined = set()
        self.visited = set()
        self.contexts = fresh_contexts()

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

    def _places(self):
        """(x, y) in the order of T.800 D.1: stripes of four rows, column by column."""
        for top in range(0, self.height, STRIPE):
            for x in range(self.width):
                for y in range(top, min(top + STRIPE, self.height)):
                    yield x, y

    def _rows_around(self, x, y):
        """Signs of the three coefficients above, beside and below.

        0: not significant, outside the code-block, or not to be seen (CAUSAL).
        """
        unseen = self.style & CAUSAL and y % STRIPE == STRIPE - 1
        rows = self.sign[y], self.sign[y + 1], self.nothing if unseen else self.sign[y + 2]
        return [row[x : x + 3] for row in rows]

    def _significant_neighbours(self, x, y):
        """How many are significant: beside, above and below, diagonal."""
        above, beside, below = self._rows_around(x, y)
        across = (beside[0] != 0) + (beside[2] != 0)
        down = (above[1] != 0) + (below[1] != 0)
        diagonal = (above[0] != 0) + (above[2] != 0) + (below[0] != 0) + (below[2] != 0)
        return across, down, diagonal

    def _decide(self, context):
        return self.raw.bit() if self.raw else self.mq.decode(self.contexts, context)

    def _become_significant(self, x, y):
        if self.raw:
            negative = self.raw.bit()
        else:
            above, beside, below = self._rows_around(x, y)
            across, down = beside[0] + beside[2], above[1] + below[1]
            context, flip = sign_context(max(-1, min(1, across)), max(-1, min(1, down)))
            negative = self.mq.decode(self.contexts, context) ^ flip
        self.sign[y + 1][x + 1] = -1 if negative else 1
        self.magnitude[y][x] = 2**self.plane

    def _significance_pass(self):
        self.visited = set()
        for x, y in self._places():
            neighbours = self._significant_neighbours(x, y)
            if self.sign[y + 1][x + 1] == 0 and sum(neighbours) > 0:
                self._code_significance(x, y, neighbours)
                self.visited.add((x, y))

    def _code_significance(self, x, y, neighbours):
        self.lowest[y][x] = self.plane
        if self._decide(significance_context(self.kind, *neighbours)):
            self._become_significant(x, y)

    def _refinement_pass(self):
        for x, y in self._places():
            if self.sign[y + 1][x + 1] == 0 or (x, y) in self.visited:
                continue
            context = FIRST_MAGNITUDE + 2
            if (x, y) not in self.refined:
                context = FIRST_MAGNITUDE + (1 if sum(self._significant_neighbours(x, y)) else 0)
            self.refined.add((x, y))
            self.lowest[y][x] = self.plane
            self.magnitude[y][x] += self._decide(context) * 2**self.plane

    def _cleanup_pass(self):
        for top in range(0, self.height, STRIPE):
            for x in range(self.width):
                self._cleanup_column(x, top)
        self.visited = set()
        if self.style & SEGMENTATION_SYMBOLS:
            symbols = [self.mq.decode(self.contexts, UNIFORM) for _ in range(4)]
            demand(symbols == [1, 0, 1, 0], "segmentation symbols")

    def _cleanup_column(self, x, top):
        rows = list(range(top, min(top + STRIPE, self.height)))
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
                self._code_significance(x, y, self._significant_neighbours(x, y))

    def _is_quiet(self, x, y):
        quiet = self.sign[y + 1][x + 1] == 0 and (x, y) not in self.visited
        return quiet and sum(self._significant_neighbours(x, y)) == 0


def decode_code_block(block, band, style):
    """Rows of wavelet coefficients of a code-block."""
    if not block.segments:
        return [[0] * block.width for _ in range(block.height)]
    decoder = CodeBlockDecoder(block, band.kind, style)
    decoder.run(block.segments, band.planes - 1 - block.missing_planes)
    return [
        [
            sign * (magnitude + 2**lowest // 2) if sign else 0
            for sign, magnitude, lowest in zip(*rows)
        ]
        for rows in zip(decoder.signs(), decoder.magnitude, decoder.lowest)
    ]
