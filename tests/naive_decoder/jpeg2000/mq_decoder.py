"""The arithmetic decoder (T.800 annex C), and bits without it (D.6)."""

# Qe, next state after the more and after the less probable symbol, whether the latter switches the
# sense of the more probable one (table C.2).
STATES = [
    (0x5601, 1, 1, 1), (0x3401, 2, 6, 0), (0x1801, 3, 9, 0), (0x0AC1, 4, 12, 0),
    (0x0521, 5, 29, 0), (0x0221, 38, 33, 0), (0x5601, 7, 6, 1), (0x5401, 8, 14, 0),
    (0x4801, 9, 14, 0), (0x3801, 10, 14, 0), (0x3001, 11, 17, 0), (0x2401, 12, 18, 0),
    (0x1C01, 13, 20, 0), (0x1601, 29, 21, 0), (0x5601, 15, 14, 1), (0x5401, 16, 14, 0),
    (0x5101, 17, 15, 0), (0x4801, 18, 16, 0), (0x3801, 19, 17, 0), (0x3401, 20, 18, 0),
    (0x3001, 21, 19, 0), (0x2801, 22, 19, 0), (0x2401, 23, 20, 0), (0x2201, 24, 21, 0),
    (0x1C01, 25, 22, 0), (0x1801, 26, 23, 0), (0x1601, 27, 24, 0), (0x1401, 28, 25, 0),
    (0x1201, 29, 26, 0), (0x1101, 30, 27, 0), (0x0AC1, 31, 28, 0), (0x09C1, 32, 29, 0),
    (0x08A1, 33, 30, 0), (0x0521, 34, 31, 0), (0x0441, 35, 32, 0), (0x02A1, 36, 33, 0),
    (0x0221, 37, 34, 0), (0x0141, 38, 35, 0), (0x0111, 39, 36, 0), (0x0085, 40, 37, 0),
    (0x0049, 41, 38, 0), (0x0025, 42, 39, 0), (0x0015, 43, 40, 0), (0x0009, 44, 41, 0),
    (0x0005, 45, 42, 0), (0x0001, 45, 43, 0), (0x5601, 46, 46, 0),
]


class MqDecoder:
    """Decodes one codeword segment. Bytes past its end read as FF."""

    def __init__(self, data):
        self.data, self.position = data, 0
        self.code = self._byte(0) << 16
        self._byte_in()
        self.code <<= 7
        self.count -= 7
        self.interval = 0x8000

    def _byte(self, position):
        return self.data[position] if position < len(self.data) else 0xFF

    def _byte_in(self):
        following = self._byte(self.position + 1)
        if self._byte(self.position) == 0xFF:
            if following > 0x8F:
                self.code += 0xFF00
                self.count = 8
                return
            self.code += following << 9
            self.count = 7
        else:
            self.code += following << 8
            self.count = 8
        self.position += 1

    def decode(self, contexts, context):
        """One decision. contexts[context] is [state, more probable symbol]; it is adapted."""
        state, symbol = contexts[context]
        estimate, after_more, after_less, switches = STATES[state]
        self.interval -= estimate
        if self.code >> 16 >= estimate:
            self.code -= estimate << 16
            if self.interval >= 0x8000:
                return symbol
            more_probable = self.interval >= estimate
        else:
            more_probable = self.interval < estimate
            self.interval = estimate
        decision = symbol if more_probable else 1 - symbol
        if not more_probable and switches:
            symbol = 1 - symbol
        contexts[context] = [after_more if more_probable else after_less, symbol]
        while self.interval < 0x8000:
            if self.count == 0:
                self._byte_in()
            self.interval <<= 1
            self.code = self.code << 1 & 0xFFFFFFFF
            self.count -= 1
        return decision


class RawBits:
    """The bits of a segment that bypasses the arithmetic coder. Bytes past its end read as FF."""

    def __init__(self, data):
        self.data, self.position = data, 0
        self.byte, self.left = 0, 0

    def bit(self):
        """The next bit; after a byte FF the first bit of the next is a stuffed 0."""
        if self.left == 0:
            self.left = 7 if self.byte == 0xFF else 8
            self.byte = self.data[self.position] if self.position < len(self.data) else 0xFF
            self.position += 1
        self.left -= 1
        return self.byte >> self.left & 1
