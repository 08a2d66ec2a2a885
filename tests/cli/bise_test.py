"""bise enc and dec against sequences packed here by the tables of the decoder from the specification."""

import itertools
import random

from program import USAGE, CliTest, main

import bise

LEVELS = [bise.levels_of(code) for code in range(40)]

# Digit group -> its greatest code (BISE-10); values that the last group lacks count as 0.
TRIT_CODE = {tuple(bise.trits(code)): code for code in range(256)}
QUINT_CODE = {tuple(bise.quints(code)): code for code in range(128)}


def pack(levels, values):
    """(bits, hex) of `values`, canonical."""
    plain, base = bise.split(levels)
    pieces, codes = {
        1: ((0,), {(0,): 0}),
        3: (bise.T_PIECES, TRIT_CODE),
        5: (bise.Q_PIECES, QUINT_CODE),
    }[base]
    stream = length = 0
    for at in range(0, len(values), len(pieces)):
        group = values[at : at + len(pieces)]
        digits = [value >> plain for value in group] if base > 1 else [0]
        code = codes[(*digits, *[0] * (len(pieces) - len(digits)))]
        for value, piece in zip(group, pieces):
            stream |= (value % 2**plain | code % 2**piece << plain) << length
            length += plain + piece
            code >>= piece
    total = bise.sequence_bits(len(values), levels)
    assert stream >> total == 0
    return total, stream.to_bytes(-(-total // 8), "little").hex()


class Bise(CliTest):
    def encoded(self, levels, values):
        bits, text = self.hmlfc("bise", "enc", levels, *values).rstrip("\n").split(" ")
        return int(bits), text

    def test_plain_bits_by_hand(self):
        # 16 levels are nibbles, the first in the low half of its byte.
        self.assertEqual(self.hmlfc("bise", "enc", 16, 1, 2, 3, 15, 0), "20 21f300\n")
        self.assertEqual(self.hmlfc("bise", "enc", 2, 1, 0, 0, 0, 0, 0, 0, 0, 1), "9 0101\n")
        self.assertEqual(self.hmlfc("bise", "enc", 256, 0, 255, 128), "24 00ff80\n")
        self.assertEqual(self.hmlfc("bise", "dec", 16, 5, "21F300"), "1 2 3 15 0\n")

    def test_trits_by_hand(self):
        # T = 00001111: T[4:2] = 3, so C = 15 and t4 = t3 = 0; C[1:0] = 3, so t2 = 2, t1 = 0, t0 = 2.
        self.assertEqual(self.hmlfc("bise", "enc", 3, 2, 0, 2, 0, 0), "8 0f\n")
        # T = 11111110: T[4:2] = 7, so C = 30 and t4 = t3 = 2; C[3:2] = 3, so t2 = t1 = 2, t0 = 2.
        self.assertEqual(self.hmlfc("bise", "enc", 3, 2, 2, 2, 2, 2), "8 fe\n")
        # 12 levels: the same T in parts behind the plain bits of 1, 2, 3, 0, 1; in stream order
        # 10 11, 01 11, 11 0, 00 00, 10 0.
        self.assertEqual(self.hmlfc("bise", "enc", 12, 9, 2, 11, 0, 1), "18 ed8300\n")
        self.assertEqual(self.hmlfc("bise", "dec", 3, 5, "00"), "0 0 0 0 0\n")

    def test_redundant_codes(self):
        # The codes that ASTC encoders agree on, of the 13 trit groups that have two.
        digits = [tuple(bise.trits(code)) for code in range(256)]
        both = {group for group in digits if digits.count(group) > 1}
        highest = {15, 47, 79, 127, 111, 252, 253, 254, 143, 175, 207, 255, 239}
        written = {int(self.encoded(3, group)[1], 16) for group in both}
        self.assertEqual(written, highest)
        # Of the quint group's codes 7, 15, 23 and 31 the greatest.
        self.assertEqual(self.hmlfc("bise", "enc", 5, 4, 4, 4), "7 1f\n")

    def test_every_code_is_accepted(self):
        for code in range(256):
            expected = " ".join(map(str, bise.trits(code)))
            self.assertEqual(self.hmlfc("bise", "dec", 3, 5, f"{code:02x}"), expected + "\n")
        for code in range(128):
            expected = " ".join(map(str, bise.quints(code)))
            self.assertEqual(self.hmlfc("bise", "dec", 5, 3, f"{code:02x}"), expected + "\n")

    def test_every_level_count_and_tail(self):
        draw = random.Random(1)
        for levels, count in itertools.product(LEVELS, (1, 2, 3, 4, 5, 16, 17)):
            values = [draw.randrange(levels) for _ in range(count)]
            with self.subTest(levels=levels, values=values):
                bits, text = self.encoded(levels, values)
                self.assertEqual((bits, text), pack(levels, values))
                if levels == 1:
                    continue
                decoded = self.hmlfc("bise", "dec", levels, count, text)
                self.assertEqual(decoded, " ".join(map(str, values)) + "\n")

    def test_one_level_takes_no_bits(self):
        self.assertEqual(self.hmlfc("bise", "enc", 1, 0, 0, 0).split(), ["0"])
        self.assertEqual(self.hmlfc("bise", "dec", 1, 3), "0 0 0\n")
        self.assertEqual(self.hmlfc("bise", "dec", 1, 3, ""), "0 0 0\n")

    def test_refused(self):
        for arguments, named in [
            (["enc", 7, 1], "allowed are 1 2 3 4 5 6 8 10 12 16"),
            (["enc", 0, 0], "allowed"),
            (["enc", 32768, 0], "16384"),
            (["enc", "0x3", 0], "allowed"),
            (["enc", 3, 3], "[0, 2]"),
            (["enc", 3, 0, -1], "-1"),
            (["enc", 3, "1.0"], "1.0"),
            (["enc", 3], "V"),
            (["dec", 7, 1, "00"], "allowed"),
            (["dec", 3, 0, ""], "COUNT"),
            (["dec", 3, 6, "00"], "10 bits, that is 2 bytes, but HEX has 1"),
            (["dec", 3, 5, "0000"], "HEX has 2"),
            (["dec", 3, 5, "0"], "whole number of bytes"),
            (["dec", 3, 5, "zz"], "hexadecimal"),
            (["dec", 3, 5, "+1"], "hexadecimal"),
            (["dec", 3, 5], "HEX has 0"),
        ]:
            with self.subTest(arguments=arguments):
                self.refused(USAGE, "bise", *arguments, says=named)


if __name__ == "__main__":
    main()
