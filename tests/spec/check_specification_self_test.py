#!/usr/bin/env python3
"""Plants one fault after another in a clean tree: each check must name exactly that fault.

Tables and the errors of the model are those of the repository, the other files are small.
"""

import re
import tempfile
import unittest
from pathlib import Path

import citations
import error_table
import frame_widths
import records
import width_probes
import widths

CLAUSES = """
A clause is written **[DEC-2]** and so on.

**[DEC-1]** First.

**[DEC-2]** Second, see DEC-1.

**[DEC-3]** Third.
"""

ROOT = Path(__file__).resolve().parents[2]
SPECIFICATION = "docs/specification.md"
RENDERING = "docs/rendering.md"


def excerpt(document, begin, end):
    """The text of a document from one string to another."""
    text = (ROOT / document).read_text()
    return text[text.index(begin) : text.index(end)]


WIDTH_TREE = {SPECIFICATION: excerpt(SPECIFICATION, "## 11", "## Annex A")}
FRAME_WIDTHS = excerpt(RENDERING, "## 6", "## 7")
FRAME_WIDTH_TREE = {RENDERING: excerpt(RENDERING, "**[CAM-3]**", "## 7")}

CITING_TREE = {
    SPECIFICATION: CLAUSES,
    RENDERING: "**[RAY-1]** A ray.\n",
    "model/decoder/block.cpp": "// First (DEC-1).\n",
    "model/decoder/golden/block.hpp": "// Both (DEC-2 to\n// DEC-3).\n",
    "model/render/ray.hpp": "// One (RAY-1).\n",
}
ERROR_TREE = {
    SPECIFICATION: excerpt(SPECIFICATION, "## Annex A", "## Annex B"),
    **{name: (ROOT / name).read_text() for name in (error_table.HEADER, error_table.SOURCE)},
}
PROBE_TREE = {
    SPECIFICATION: "## 11 Widths\n\n| quantity | clause |\n|---|---|\n| sum | A |\n| d, e | B |\n",
    RENDERING: "## 6 Widths\n\n| quantity | clause |\n|---|---|\n| U * s | C |\n",
    "model/arithmetic/sum.hpp": '  watch("sum", sum, range);\n',
    "model/decoder/golden/entry.cpp": '  watch(\n      "d, e", d);\n',
    "model/render/ray.hpp": '  watch("U * s", product);\n',
}


TREES = {
    citations: CITING_TREE,
    error_table: ERROR_TREE,
    width_probes: PROBE_TREE,
    widths: WIDTH_TREE,
    frame_widths: FRAME_WIDTH_TREE,
}
BLOCK, GOLDEN = "model/decoder/block.cpp", "model/decoder/golden/block.hpp"
RAY, SUM = "model/render/ray.hpp", "model/arithmetic/sum.hpp"
UNWATCHED = "nothing in model/arithmetic, syntax, decoder watches sum"
UNWATCHED_RAY = "nothing in model/render watches U * s"
WIDTH_ROW = "| vector component | TIL-7 | | [-127, 127] | the same | 8 | 8 |\n"
FRAME_ROW = "| wr, wc | SMP-1 | | [0, 256] | 9 |\n"
NO_DEPTH = "bits name a depth where"

# Of each check: a file of its tree, what is replaced in it by what, and the words of each violation. A file
# that the tree does not have holds the old text before.
FAULTS = {
    citations: [
        (BLOCK, "(DEC-1)", "(DEC-1, DEC-4)", "block.cpp: cites DEC-4"),
        (BLOCK, "(DEC-1)", "(DEC-1, DCE-2)", "block.cpp: cites DCE-2"),
        (BLOCK, "(DEC-1)", "(DEC-1 to DEC-4)", "block.cpp: cites DEC-4"),
        (BLOCK, "(DEC-1)", '(DEC-1) field("TIL-7")', "block.cpp: cites TIL-7"),
        (SPECIFICATION, "see DEC-1", "see DEC-7", "specification.md: cites DEC-7"),
        (RENDERING, "A ray", "See RAY-2", "rendering.md: cites RAY-2"),
        ("docs/guide.md", "x", "DEC-8", "docs/guide.md: cites DEC-8"),
        ("tools/cli/info.cpp", "x", "// IDX-1", "tools/cli/info.cpp: cites IDX-1"),
        ("tools/cli/info.cpp", "x", "CRC-32C and UTF8 are no clauses"),
        (BLOCK, "(DEC-1)", "", "DEC-1 is cited nowhere"),
        (GOLDEN, "\n// DEC-3", "", "DEC-3 is cited nowhere"),
        (RAY, "(RAY-1)", "", "rendering.md: RAY-1 is cited nowhere"),
        (SPECIFICATION, "Third.", "Third.\n\n**[DEC-5]** x", "DEC-5 is cited nowhere"),
        (SPECIFICATION, "**[DEC-3]**", "**[DEC-2]** x\n**[DEC-3]**", "2 times"),
        (RENDERING, "**[RAY-1]**", "**[DEC-2]** x\n**[RAY-1]**", "specification.md: DEC-2 is defined 2 times",
         "rendering.md: DEC-2 is defined", "rendering.md: DEC-2 is cited nowhere"),
    ],
    error_table: [
        (SPECIFICATION, "not an HMLFC stream", "no stream", "error.cpp: error 2 is"),
        (error_table.SOURCE, "not an HMLFC stream", "no stream", "error.cpp: error 2 is"),
        (SPECIFICATION, "| bad_magic", "| bad_majic", "error.hpp: error 2", "error.cpp: error 2"),
        (error_table.SOURCE, '"bad_magic"', '"bad_majic"', "error.cpp: error 2"),
        (error_table.HEADER, "kBadMagic", "kBadMajic", "error.hpp: error 2"),
        (error_table.HEADER, "kBadMagic = 2,\n  kBadVersion = 3", "kBadMagic = 3,\n  kBadVersion = 2",
         "error 2 is bad_version", "error 3 is bad_magic"),
        (SPECIFICATION, "| 27 | bus_error | a read failed: of memory, in hardware, or of the stream's source |\n", "", "", "", ""),
        (error_table.HEADER, "Count = 28", "Count = 29", "kErrorCodeCount is 29"),
    ],
    width_probes: [
        (SUM, '"sum"', '"sums"', UNWATCHED,
         "model/arithmetic/sum.hpp watches sums, which is no row of docs/specification.md"),
        (SUM, "watch", "match", UNWATCHED),
        (SPECIFICATION, "| d, e | B |\n", "", "entry.cpp watches d, e, which is no row"),
        (RAY, '"U * s"', '"U"', UNWATCHED_RAY, "ray.hpp watches U, which is no row of docs/rendering.md"),
        (RAY, "watch", "match", UNWATCHED_RAY),
        (RAY, '"U * s"', '"sum"', UNWATCHED_RAY, "ray.hpp watches sum, which is no row"),
        (RENDERING, "| U * s |", "| V |", "watches V", "watches U * s, which is no row"),
    ],
    widths: [
        (SPECIFICATION, WIDTH_ROW, "", "vector component is missing"),
        (SPECIFICATION, WIDTH_ROW, WIDTH_ROW + WIDTH_ROW.replace("vector", "other"), "other component is not in"),
    ],
    frame_widths: [
        (RENDERING, "| 16 (n = 12) |", "| 16 |", NO_DEPTH),
        (RENDERING, "| 17 |", "| 17 (n = 12) |", NO_DEPTH),
        (RENDERING, "| [1, 4096] |", "| [1, 2048] |", "a, b", "na_lo", "n:", "r:", "n * r:"),
        (RENDERING, "pz in [-4096, 4096]", "pz in [-4096, 2048]", "zu, zv", "U, V"),
        (RENDERING, "abs(x0) <= 2^28", "abs(x0) <= 2^27", "xb, yb", "x(c), y(r)", "x(c, E), y(r, E)"),
        (RENDERING, "[1/16, 127/16]", "[1/16, 63/16]", "G:", "E * (c * 2^12", "x(c, E), y(r, E)"),
        (RENDERING, FRAME_ROW, "", "wr, wc is missing"),
        (RENDERING, FRAME_ROW, FRAME_ROW + FRAME_ROW.replace("wr, wc", "other"), "other is not in the quantities"),
    ],
}


class SpecificationTest(unittest.TestCase):
    def found_in(self, check, tree):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in tree.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(check.violations(Path(folder)))

    def found(self, check, name, old, new):
        """The violations of the clean tree after replacing `old` by `new` in one of its files."""
        text = TREES[check].get(name, old)
        self.assertTrue(old in text, old)
        return self.found_in(check, {**TREES[check], name: text.replace(old, new, 1)})

    def assert_found(self, check, name, old, new, *expected):
        with self.subTest(check=check.__name__, file=name, fault=new):
            found = self.found(check, name, old, new)
            self.assertEqual(len(found), len(expected), found)
            for violation, words in zip(found, expected):
                self.assertIn(words, violation)


class FaultsTest(SpecificationTest):
    def test_clean_trees(self):
        for check, tree in TREES.items():
            self.assertEqual(self.found_in(check, tree), [])

    def test_planted_faults(self):
        for check, faults in FAULTS.items():
            for fault in faults:
                self.assert_found(check, *fault)

    def test_citations_of_the_encoder_do_not_count(self):
        moved = {"model/encoder/block.cpp": "// DEC-1", BLOCK: ""}
        found = self.found_in(citations, {**CITING_TREE, **moved})
        self.assertEqual(len(found), 1, found)
        self.assertIn("DEC-1 is cited nowhere", found[0])


class RecordsTest(unittest.TestCase):
    text = (ROOT / SPECIFICATION).read_text()

    def plant(self, old, new, *expected):
        self.assertTrue(old in self.text, old)
        found = records.found_in(self.text.replace(old, new, 1), ROOT)
        for words in expected:
            self.assertTrue(any(words in violation for violation in found), (words, found))

    def test_wrong_cells(self):
        for old, new, words in (
            ("| sign_mode | 2 |", "| sign_mode | 3 |", "sign_mode has 2 bits"),
            ("| explicit_y | explicit_bits |", "| explicit_y | 12 |", "explicit_y has"),
            ("popcount(tile_mask) x offset_bits", "popcount(tile_mask) x 16", "end has"),
            ("motion_mask), codes_y)", "motion_mask), codes_x)", "dy has"),
            ("palette_size + 1)) | u", "palette_size)) | u", "index has"),
            ("always | STP-1 | bad", "always | TIL-8 | bad", "step_delta has 0 bits (STP-1)"),
            ("| 3 | u | [0, 7] | two_references", "| 3 | u | [0, 7] | level_keys", "reference_set is read"),
            ("u | [0, 2] | no motion_tiles", "u | [0, 2] | motion_tiles", "sign_mode is read"),
            ("| 18 | cols | u16", "| 18 | cols | u8", "width is not at offset 19"),
            ("| 4 | crc | u32", "| 5 | crc | u32", "crc is not at offset 4"),
            ("| 39 | row_scale | i8", "| 39 | row_scale | u8", "header: row_scale is"),
            ("| 6 | lossy_keys", "| 9 | lossy_keys", "lossy_keys is not bit 9"),
        ):
            with self.subTest(new=new):
                self.plant(old, new, words)

    def test_rows(self):
        row = "| bias | bias_bits | s | any | all | always | TIL-8 | |\n"
        self.plant(row, "", "residual tile: no table has bias")
        self.plant(row, row + row.replace("| bias |", "| other |"), "residual tile: nothing reads other")


class WidthsTest(SpecificationTest):
    def plant(self, old, new, row, words):
        """Every violation is of `row`, and one says `words`."""
        found = self.found(widths, SPECIFICATION, old, new)
        self.assertTrue(found, new)
        self.assertTrue(all(v.startswith(f"widths: {row}: ") for v in found), found)
        self.assertTrue(any(words in v for v in found), found)

    def test_wrong_bits(self):
        value, at8, at12 = "BISE value", "bits at n = 8 should be", "bits at n = 12 should be"
        self.plant("the same | 10 | 14", "the same | 11 | 14", value, at8)
        self.plant("the same | 10 | 14", "the same | 10 | 13", value, at12)
        self.plant("| 8 | 8 |", "| 7 | 8 |", "vector component", at8)
        self.plant("| 26 | 26 |", "| 26 | 25 |", "image number", at12)
        self.plant("1299 | | | 16", "1299 | | | 17", "bit position in a tile record", at8)

    def test_every_interval_too_narrow_or_too_wide(self):
        chroma = "[-(2^n - 1), 2^n - 1] | 9"
        for row, old, faults in (
            ("sample, parent P", f"[0, 2^n - 1] | {chroma}", [f"[0, 2^n - 2] | {chroma}"]),
            ("sample, parent P", f"[0, 2^n - 1] | {chroma}", [f"[0, 2^n] | {chroma}"]),
            ("sample, parent P", chroma, ["[-(2^n - 2), 2^n - 1] | 9", "[-2^n, 2^n - 1] | 9"]),
            ("residual bound M", "| 2^(n+1) - 2 |", ["| 2^(n+1) - 3 |", "| 2^(n+1) - 1 |"]),
            ("BISE value", "[0, 2^(n+2) - 1]", ["[0, 2^(n+2) - 2]", "[0, 2^(n+2)]"]),
            ("bias", "[-2^(n+1), 2^(n+1) - 1]", ["[-2^(n+1) + 1, 2^(n+1) - 1]"]),
            ("residual before its clamp", "2^(n+2) - 2]", ["2^(n+2) - 1]", "2^(n+2) - 3]"]),
            ("residual, SRV reference", "2^(n+1) - 2] | 10", ["2^(n+1) - 1] | 10"]),
            ("P + sign * ref", "[-3(2^n - 1), 3(2^n - 1)]", ["[-3(2^n - 1), 3(2^n - 1) - 1]"]),
            ("P + sign * ref", "2^(n+1) - 2] | [-3", ["2^(n+1) - 1] | [-3", "2^(n+1) - 3] | [-3"]),
            ("vector component", "[-127, 127]", ["[-128, 127]", "[-127, 126]"]),
            ("step * residual", "256(2^n - 1)] |", ["256(2^n - 1) - 1] |", "256(2^n - 1) + 1] |"]),
            ("disparity", "[-4096, 4095]", ["[-4095, 4095]", "[-4096, 4096]"]),
            ("rk - r, ck - c", "[-382, 382]", ["[-381, 382]", "[-382, 383]"]),
            ("d * row_scale * (rk - r)", "127 * 382] |", ["127 * 381] |", "128 * 382] |"]),
            ("I", "64(2^n - 1)] |", ["64(2^n - 1) - 1] |", "64(2^n - 1) + 1] |"]),
            ("I_first + I_second + 64", "(2^n - 1) + 64] |", ["(2^n - 1) + 63] |"]),
            ("t", "[-(2^(n-1) - 1), 3", ["[-2^(n-1), 3", "[-(2^(n-1) - 2), 3"]),
            ("t", "3 * 2^(n-1) - 1]", ["3 * 2^(n-1) - 2]", "3 * 2^(n-1)]"]),
            ("B before its clamp", "[-(2^n - 2),", ["[-(2^n - 1),", "[-(2^n - 3),"]),
            ("B before its clamp", "2^(n+1) - 1] | | 10", ["2^(n+1) - 2] | | 10"]),
            ("image number", "4096 * 8194 - 1]", ["4096 * 8194 - 2]"]),
            ("tile number", "2 * 2^22) - 1]", ["2 * 2^22) - 2]"]),
            ("bit position in a tile record", "n + 11) + 1299", ["n + 11) + 1298"]),
        ):
            for new in faults:
                with self.subTest(row=row, fault=new):
                    self.plant(old, new, row, "at n = 3 values reach")


class FrameWidthsTest(SpecificationTest):
    def plant(self, old, new, *expected):
        self.assert_found(frame_widths, RENDERING, old, new, *expected)

    def test_wrong_bits(self):
        for row in re.findall(r"^\| .*\d.* \|$", FRAME_WIDTHS, re.MULTILINE):
            quantity, bits = row.split(" | ")[0], row.rsplit("| ", 1)[1]
            number = int(bits.split()[0])
            for wrong in (number - 1, number + 1):
                new = row.replace(f"| {bits}", f"| {bits.replace(str(number), str(wrong), 1)}")
                self.plant(row, new, f"{quantity[2:]}: bits should be {number}")

    def test_intervals(self):
        for old, new, words in (
            ("[-4095, 4095]", "[-4095, 4094]", "a, b: at n = 12 values reach"),
            ("[-4095, 4095]", "[-4096, 4095]", "a, b: at n = 12 values reach"),
            ("[-805131609, 805131608]", "[-805131609, 805131607]", "n: at n = 12 values reach"),
            ("[-805131609, 805131608]", "[-805131610, 805131608]", "n: at n = 12 values reach"),
            ("[178995814, 2^31 - 1]", "[178995814, 2^31 - 2]", "r: at n = 12 values reach"),
            ("[178995814, 2^31 - 1]", "[178995813, 2^31 - 1]", "r: at n = 12 values reach"),
            ("2^59 - 715983262]", "2^59 - 715983261]", "n * r: at n = 12 values reach"),
            ("[-(2^30 - 1), 2^30 - 2]", "[-(2^30 - 1), 2^30 - 1]", "sx, sy: at n = 12 values"),
            ("[-(2^58 - 2^28), ", "[-2^58 + 1, ", "zu * sx, gain * sx: at n = 12 values reach"),
            ("[-2^28, 2^29] | 31", "[-2^28, 2^29 - 1] | 30", "u0, v0: at n = 12 values reach"),
            ("[0, 256]", "[0, 257]", "wr, wc: at n = 12 values reach"),
            ("[0, 16 * (2^n - 1)]", "[0, 16 * (2^n - 1) - 1]", "q: at n = 3 values reach"),
            ("[2^19, ", "[2^18, ", "sum over views: at n = 3 values reach"),
        ):
            self.plant(old, new, words)


if __name__ == "__main__":
    unittest.main()
