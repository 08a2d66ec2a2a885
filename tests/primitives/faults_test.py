"""`hmlfc primitives check` catches faults planted into the functions that answer, and into the pipe."""

from unittest.mock import patch

from primitives_case import ANSWERS, DIFFERENT, PrimitivesTest, answered, main  # finds the naive decoder

import bise
import bit_string
import colour
import crc32c
import geometry
import groups
import integers
import interpolation
import references
import residual
import tile_mask
from jpeg2000 import code_block, wavelet

RIGHT_TRITS, RIGHT_QUINTS, RIGHT_LEAST = bise.trits, bise.quints, bise.least_code
RIGHT_LEVELS, RIGHT_BITS, RIGHT_STEP = bise.levels_of, bise.sequence_bits, residual.step_of
RIGHT_CLAMP, RIGHT_CRC, RIGHT_INTERVAL = integers.clamp, crc32c.crc32c, geometry.Geometry.interval
RIGHT_REFERENCE, RIGHT_CANDIDATES = groups.Groups.reference, references.candidates
RIGHT_NEXT, RIGHT_RECONSTRUCTED = references.next_group, code_block.reconstructed
RIGHT_RGB, RIGHT_INTERPOLATE, RIGHT_ONE = colour.to_rgb, interpolation.interpolate, bise.read_one


def read_past_the_end(bits, position, count, levels):
    """Bits of T and Q that are cut off are those behind the sequence (BISE-7)."""
    long = count + 5
    rest = bits.value >> position
    return bise.decode(rest, long, levels)[:count]


def low_clamp(x, lo, hi):
    """The upper end is off by one (CNV-2)."""
    return RIGHT_CLAMP(x, lo, hi - 1)


# Primitive, what is wrong, where it is replaced, and by what.
FAULTS = [
    ("field", "a sign bit that counts upwards", integers, "signed", lambda field, bits: field),
    ("field", "one bit too far", bit_string.BitString, "field",
     lambda self, position, bits: (self.value >> position + 1) % 2**bits),
    ("rank", "counts bit i itself", integers, "rank", lambda mask, i: integers.popcount(mask % 2 ** (i + 1))),
    ("crc", "no final exclusive-or", crc32c, "crc32c", lambda data: RIGHT_CRC(data) ^ 0xFFFFFFFF),
    ("block-number", "rows and columns swapped", tile_mask, "block_number",
     lambda i, j: 4 * (4 * (i >> 1) + (j >> 1)) + 2 * (i & 1) + (j & 1)),
    ("mask", "blocks row by row", tile_mask, "block_number", lambda i, j: 8 * j + i),
    ("image-number", "level 0 first", geometry.Geometry, "image_number",
     lambda self, image: sum(a * b for a, b in self.grids[: image[0]]) + image[1] * self.grids[image[0]][1] + image[2]),
    ("tile-number", "motion tiles do not count", geometry.Geometry, "tiles_of_image",
     lambda self: self.tiles_before(3)),
    ("tile-number", "motion tiles of 8 blocks", geometry.Geometry, "tile_side", lambda self, plane: 8 * self.block),
    ("group-small", "the upper one of two in the middle", groups.Groups, "reference",
     lambda self, group: min(RIGHT_REFERENCE(self, group) + 1, self.images - 1)),
    ("group", "balanced as not balanced", groups.Groups, "group_of", lambda self, image: image // self.size),
    ("references", "away from the image", references, "next_group",
     lambda line, at: RIGHT_NEXT(line, 2 * line.reference(line.group_of(at)) - at)),
    ("references", "K1 and K2 in one order", references, "candidates",
     lambda g, image: (lambda k: [k[0], *sorted(k[1:3]), k[3]])(RIGHT_CANDIDATES(g, image))),
    ("levels", "5 and 6 swapped", bise, "levels_of", lambda code: RIGHT_LEVELS(code + 1 if code % 3 == 1 else code)),
    ("least-code", "more, not as many", bise, "least_code", lambda levels: RIGHT_LEAST(levels + 1)),
    ("vector-fields", "2^v > 2W + 1", integers, "least_bits", lambda count: count.bit_length()),
    ("trits", "one wrong code", bise, "trits", lambda T: RIGHT_TRITS(T) if T != 0xDF else [0, 2, 2, 1, 1]),
    ("quints", "one wrong code", bise, "quints", lambda Q: RIGHT_QUINTS(Q) if Q != 0x1F else [4, 4, 3]),
    ("sequence-bits", "rounded down", bise, "sequence_bits",
     lambda count, levels: RIGHT_BITS(count, levels) - (levels % 3 == 0 and count % 5 != 0)),
    ("sequence-tail", "one wrong T code", bise, "trits", lambda T: RIGHT_TRITS(T) if T != 0x1C else [0, 0, 0, 2, 1]),
    ("sequence-tail", "one wrong Q code", bise, "quints", lambda Q: RIGHT_QUINTS(Q) if Q != 0x0F else [4, 4, 0]),
    ("sequence", "the tail is not cut", bise, "read", read_past_the_end),
    ("sequence-value", "the tail is not cut", bise, "read", read_past_the_end),
    ("sequence-value", "the value before", bise, "read_one",
     lambda bits, position, count, levels, i: RIGHT_ONE(bits, position, count, levels, max(i - 1, 0))),
    ("step", "3 * 2^k too early", residual, "step_of", lambda code: RIGHT_STEP(code) if code != 2 else 2),
    ("residual", "a bias without step", residual, "residual_of",
     lambda value, levels, bias, step, bound: RIGHT_CLAMP(step * (value - (levels >> 1)) + bias, -bound, bound)),
    ("residual", "one clamp off by one", residual, "clamp", low_clamp),
    ("residual", "N / 2 rounded up", residual, "residual_of",
     lambda value, levels, bias, step, bound: RIGHT_CLAMP(
         step * RIGHT_CLAMP(value - (levels + 1 >> 1) + bias, -bound, bound), -bound, bound)),
    ("prediction", "upper clamp off by one", integers, "clamp", low_clamp),
    ("prediction", "chroma not below 0", geometry.Geometry, "interval",
     lambda self, plane: (0, RIGHT_INTERVAL(self, plane)[1])),
    ("sample", "upper clamp off by one", integers, "clamp", low_clamp),
    ("colour", "upper clamp off by one", colour, "clamp", low_clamp),
    ("colour", "Y - Cg / 2, rounded to zero", colour, "to_rgb",
     lambda y, co, cg, depth: RIGHT_RGB(y - int(cg / 2) + (cg >> 1), co, cg, depth)),
    ("disparity-vector", "rounds down", references, "rshift", lambda x, k: x >> k),
    ("disparity-vector", "the clamp off by one", references, "clamp", low_clamp),
    ("explicit-vector", "the clamp off by one", references, "clamp", low_clamp),
    ("displacement", "u >> 1 without rounding", interpolation, "eighths",
     lambda component, precision, halved: component * 2 ** (3 - precision) >> halved),
    ("interpolation", "rounds to zero", interpolation, "predict", lambda sums: int((sums[0] + 32) / 64)),
    ("interpolation", "weights swapped", interpolation, "interpolate",
     lambda ref, x, y, ux, uy: RIGHT_INTERPOLATE(ref, x, y, uy, ux)),
    ("interpolation-two", "each rounded alone", interpolation, "predict",
     lambda sums: ((sums[0] + 32 >> 6) + (sums[1] + 32 >> 6) + 1) >> 1),
    ("interpolation-two", "+ 63", interpolation, "predict", lambda sums: sums[0] + sums[1] + 63 >> 7),
    ("coefficient", "the lower end", code_block, "reconstructed", lambda sign, magnitude, lowest: sign * magnitude),
    ("key-plane", "the lower end", code_block, "reconstructed", lambda sign, magnitude, lowest: sign * magnitude),
    ("key-plane", "the middle with plane 0", code_block, "reconstructed",
     lambda sign, magnitude, lowest: RIGHT_RECONSTRUCTED(sign, magnitude, max(lowest, 1))),
    ("key-plane", "no clamp", integers, "clamp", lambda x, lo, hi: x),
    ("key-plane", "no symmetric extension", wavelet, "mirrored",
     lambda values, index: values[RIGHT_CLAMP(index, 0, len(values) - 1)] if index < 0 or index >= len(values) else values[index]),
]  # fmt: skip


class Faults(PrimitivesTest):
    def test_every_primitive_has_a_fault(self):
        self.assertEqual({name for name, *_ in FAULTS}, set(ANSWERS))

    def test_faults_of_functions(self):
        clauses = {entry["name"]: entry["clauses"] for entry in self.hmlfc_json("primitives", "list")}
        for name, fault, *place in FAULTS:
            with self.subTest(primitive=name, fault=fault):
                cases = self.cases(name)
                with patch.object(*place):
                    lines = [answered(name, case) for case in cases]
                status, printed = self.check(name, lines, "--errors", 1)
                self.assertEqual(status, DIFFERENT)
                self.assertRegex(printed[0], rf"^line \d+: .*({clauses[name]})")
                self.assertEqual(len(printed), 2)

    def right(self, name="prediction"):
        return [answered(name, case) for case in self.cases(name)]

    def assert_caught(self, lines, says, name="prediction", *options):
        status, printed = self.check(name, lines, *options)
        self.assertEqual(status, DIFFERENT)
        self.assertIn(says, "\n".join(printed))
        return printed

    def test_lines_that_are_missing(self):
        lines = self.right()
        self.assert_caught(lines[:-1], f"the input ends before line {len(lines)}")
        self.assert_caught([], "the input ends before line 1")
        self.assert_caught(lines[1:], "line 1 has to begin with")
        self.assert_caught(lines[:7] + lines[8:], "line 8 has to begin with")
        self.assert_caught(self.right("colour")[:-1], "the input ends", "colour", "--level", 2)

    def test_lines_that_are_out_of_place(self):
        lines = self.right()
        self.assert_caught([*lines, lines[-1]], f"there are {len(lines)} cases, but the input goes on with")
        self.assert_caught([*lines, ""], "but the input goes on")
        self.assert_caught([lines[1], lines[0], *lines[2:]], "line 1 has to begin with")
        self.assert_caught(["", *lines], "line 1 has to begin with")
        printed = self.assert_caught(lines, "line 1 has to begin with", "prediction", "--seed", 2)
        self.assertEqual(len(printed), 2)

    def test_results_that_are_missing(self):
        lines = self.right()
        self.assert_caught(self.cases("prediction"), "0 results instead of 1: A (DEC-3)")
        self.assert_caught([lines[0] + " 0", *lines[1:]], "2 results instead of 1")
        self.assert_caught([*lines[:-1], lines[-1].rsplit(" ", 1)[0]], f"line {len(lines)}: ")
        self.assert_caught([lines[0] + "x", *lines[1:]], "result 1 of 1 is")
        self.assert_caught(["9" * 100000, *lines], "line 1 has to begin with")
        self.assert_caught(["\x1b[2J\x7f", *lines], "but is '?[2J?'")

    def test_stops_after_errors(self):
        cases = self.cases("block-number")
        wrong = [f"{case} 64" for case in cases]
        printed = self.assert_caught(wrong, "errors: 20", "block-number")
        self.assertEqual(printed[0], "line 1: i 0, j 0: result 1 of 1 is 64 instead of 0: k (TIL-2)")
        self.assertEqual(printed[20:], ["block-number: 20 of 64 cases compared, errors: 20"])
        printed = self.assert_caught(wrong, "errors: 3", "block-number", "--errors", 3)
        self.assertEqual(len(printed), 4)
        printed = self.assert_caught(wrong, "errors: 64", "block-number", "--errors", 65)
        self.assertEqual(len(printed), 65)


if __name__ == "__main__":
    main()
