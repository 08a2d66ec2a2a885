"""Sequences of the naive decoder against the program's, and against the inverse of its own tables."""

import paths  # noqa: F401
import random

import bise
from program import CliTest, main

LEVELS = [bise.levels_of(code) for code in range(40)]


class BiseTest(CliTest):
    def test_level_codes_are_all_products_in_order(self):
        products = {2**n * digit for n in range(15) for digit in (1, 3, 5)}
        self.assertEqual(LEVELS, sorted(levels for levels in products if levels <= LEVELS[-1]))

    def test_digit_groups_have_the_number_of_codes_of_bise_10(self):
        trits = [tuple(bise.trits(T)) for T in range(256)]
        quints = [tuple(bise.quints(Q)) for Q in range(128)]
        self.assertEqual((len(set(trits)), len(set(quints))), (3**5, 5**3))
        twice = [group for group in set(trits) if trits.count(group) > 1]
        self.assertEqual(len(twice), 13)
        self.assertEqual(quints.count((4, 4, 4)), 4)

    def test_random_bits_decode_as_the_program_decodes_them(self):
        rng = random.Random(1)
        for levels in LEVELS:
            count = rng.randint(1, 20)
            bits = bise.sequence_bits(count, levels)
            sequence = rng.getrandbits(bits) if bits else 0
            data = sequence.to_bytes((bits + 7) // 8, "little").hex()
            said = self.hmlfc("bise", "dec", levels, count, *([data] if data else []))
            self.assertEqual(bise.decode(sequence, count, levels), [int(word) for word in said.split()])

    def test_what_the_program_encodes_decodes_to_the_same_values(self):
        rng = random.Random(2)
        for levels in LEVELS:
            values = [rng.randrange(levels) for _ in range(rng.randint(1, 17))]
            bits, *data = self.hmlfc("bise", "enc", levels, *values).split()
            sequence = int.from_bytes(bytes.fromhex("".join(data)), "little")
            self.assertEqual(int(bits), bise.sequence_bits(len(values), levels))
            self.assertEqual(bise.decode(sequence, len(values), levels), values)


main()
