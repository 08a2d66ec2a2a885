#!/usr/bin/env python3
"""The mutants of a source, their choice, and the reasons of the survivors."""

import argparse
import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import mutate  # makes the folders of the others known
import session
from cpp import mutants_of
from mutants import Mutant, reasons_of, survivors_in
from session import Verdict

SOURCE = """\
// a + b
int f(const std::vector<int>& a, int* b) {  // 1 < 2
  if (a < b && !c) return x - 1u;
  return "a + b" == 0x1F ? std::min<int>(a, b) : y;
}
"""


def changes(text, **options):
    return [(m.line, m.old, m.new) for m in mutants_of("f.cpp", text, **options)]


class MutantsTest(unittest.TestCase):
    def test_operators_and_numbers(self):
        self.assertEqual(
            changes(SOURCE),
            [
                *((3, "<", "<="), (3, "<", ">"), (3, "&&", "||"), (3, "!", "")),
                *((3, "-", "+"), (3, "1", "2"), (3, "1", "0")),
                *((4, "==", "!="), (4, "0x1F", "32"), (4, "0x1F", "30"), (4, "min", "max")),
            ],
        )

    def test_skipped_lines(self):
        self.assertEqual({line for line, _, _ in changes(SOURCE, skipped={3})}, {4})

    def test_no_code(self):
        self.assertEqual(changes('#include "a"\nstatic_assert(a < 1);\nassert(a < 1);\n'), [])

    def test_applied(self):
        mutant = Mutant.of("operator", "f.cpp", SOURCE, SOURCE.index("< b &&"), "<", ">=")
        self.assertEqual(str(mutant), "f.cpp:3:9: < -> >=")
        self.assertIn("if (a >= b && !c)", mutant.apply(SOURCE))
        self.assertEqual(mutant.apply(SOURCE).count("\n"), SOURCE.count("\n"))

    def test_choice(self):
        mutants = mutants_of("f.cpp", SOURCE)
        self.assertEqual(mutate.drawn(mutants, 5), mutate.drawn(mutants[::-1], 5))
        self.assertNotEqual(mutate.drawn(mutants, 5), mutate.drawn(mutants, 6))
        self.assertEqual(set(mutate.drawn(mutants, 1)), set(mutants))

    def test_survivors_of_a_report(self):
        mutants = mutants_of("f.cpp", SOURCE)
        report = """\
1/3 f.cpp:3:16: ! -> nothing: survived
2/3 f.cpp:3:9: < -> <=: syntax/levels
survived: f.cpp:3:31: 1 -> 2    if (a < b && !c) return x - 1u;
survived: f.cpp:3:16: ! -> nothing    if (a < b && !c) return x - 1u;
"""
        self.assertEqual(
            [str(mutant) for mutant in survivors_in(report, mutants)],
            ["f.cpp:3:16: ! -> nothing", "f.cpp:3:31: 1 -> 2"],
        )
        with self.assertRaisesRegex(ValueError, "f.cpp:9:9"):
            survivors_in("survived: f.cpp:9:9: < -> >    x\n", mutants)

    def test_results_of_a_run_that_was_cut_off(self):
        mutants = mutants_of("f.cpp", SOURCE)
        progress = """\
1/3 f.cpp:3:16: ! -> nothing: survived
2/3 f.cpp:3:9: < -> <=: killed syntax/levels
3/3 f.cpp:3:31: 1 -> 2: equivalent a reason: it survived
f.cpp:3:31: 1 -> 0: killed
4/3 f.cpp:9:9: < -> <=: killed of another source
"""
        tried = []
        with tempfile.NamedTemporaryFile("w") as file:
            file.write(progress)
            file.flush()
            options = argparse.Namespace(resume=Path(file.name), jobs=1)
            with contextlib.redirect_stderr(io.StringIO()):
                results = session.run(mutants, lambda m: tried.append(m) or Verdict("crash"), {}, options)
        kept = {str(m): (v.result, v.detail) for m, v in results if m not in tried}
        self.assertEqual(
            kept,
            {
                "f.cpp:3:16: ! -> nothing": ("survived", ""),
                "f.cpp:3:9: < -> <=": ("killed", "syntax/levels"),
                "f.cpp:3:31: 1 -> 2": ("survived", ""),
            },
        )
        self.assertEqual(len(tried), len(mutants) - len(kept))

    def reasons(self, *entries):
        text = "  a = b < c && d < e;\n  a = 1;\n  b = 1;\n  a = 1;\n"
        keys = ("line", "change", "reason", "nth")
        named = [{"file": "f.cpp", **dict(zip(keys, entry))} for entry in entries]
        found = reasons_of(named, mutants_of("f.cpp", text))
        return {str(mutant): reason for mutant, reason in found.items()}

    def test_reasons(self):
        self.assertEqual(
            self.reasons(
                ("b = 1;", "1 -> 2", "x"),
                ("a = 1;", "1 -> 2", "y", 1),
                ("a = b < c && d < e;", "< -> >", "z", 1),
            ),
            {
                **{"f.cpp:3:7: 1 -> 2": "x", "f.cpp:4:7: 1 -> 2": "y"},
                **{"f.cpp:1:18: < -> >": "z"},
            },
        )

    def test_reasons_that_fit_no_mutant(self):
        for entry in [
            ("b = 2;", "2 -> 3", "the line has changed"),
            ("b = 1;", "1 -> 7", "no such change"),
            ("a = 1;", "1 -> 2", "of two"),
            ("a = 1;", "1 -> 2", "the third of two", 2),
        ]:
            with self.assertRaises(ValueError, msg=entry[2]):
                self.reasons(entry)
        with self.assertRaisesRegex(ValueError, "two reasons"):
            self.reasons(("b = 1;", "1 -> 2", "x"), ("b = 1;", "1 -> 2", "y"))

    def test_reasons_of_the_model(self):
        self.assertTrue(all(mutate.equivalents().values()))


if __name__ == "__main__":
    unittest.main()
