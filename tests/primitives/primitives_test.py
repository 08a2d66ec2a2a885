"""The naive decoder gives the results of all cases of examples/primitives, and the example reads them."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

from answers import ANSWERS, answered

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "examples" / "primitives"
FIXED_RANGE = re.compile(r"#   (\S+) +\[(-?\d+), (-?\d+)\]$")


class Primitives(unittest.TestCase):
    def test_naive_decoder_agrees(self):
        self.assertEqual({path.stem for path in CASES.iterdir()}, set(ANSWERS))
        for name in ANSWERS:
            with self.subTest(primitive=name):
                lines = (CASES / f"{name}.txt").read_text().splitlines()
                self.assertEqual([answered(name, line) for line in lines], lines)

    def test_cases_reach_both_ends_of_every_range(self):
        for name in ANSWERS:
            lines = (CASES / f"{name}.txt").read_text().splitlines()
            columns = [line for line in lines if line.startswith("#   ")]
            rows = [line.partition(" ->")[0].split() for line in lines if not line.startswith("#")]
            for at, column in enumerate(columns):
                if found := FIXED_RANGE.match(column):
                    with self.subTest(primitive=name, column=found[1]):
                        values = {int(row[at]) for row in rows}
                        self.assertEqual([min(values), max(values)], [int(found[2]), int(found[3])])

    def test_clauses(self):
        documents = "".join((ROOT / f"docs/{name}.md").read_text() for name in ("specification", "rendering"))
        clauses = set(re.findall(r"^\*\*\[(\w+-\d+)\]\*\*", documents, re.MULTILINE))
        for name in ANSWERS:
            title = (CASES / f"{name}.txt").read_text().partition("\n")[0]
            self.assertTrue(title.startswith(f"# {name}: "), title)
            self.assertLessEqual(set(title.partition(": ")[2].split()), clauses)

    def run_example(self, name, path):
        command = [sys.executable, "-B", ROOT / "examples/primitives.py", name, path]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout

    def test_example(self):
        for name in ("colour", "block-number"):
            status, text = self.run_example(name, CASES / f"{name}.txt")
            self.assertEqual(status, 0)
            self.assertRegex(text, rf"^{name}: \d+ cases, all right\n$")
        document = (ROOT / "docs/primitives.md").read_text()
        self.assertIn(self.run_example("colour", CASES / "colour.txt")[1], document)
        self.assertIn("\n".join((CASES / "colour.txt").read_text().splitlines()[:7]), document)
        status, text = self.run_example("colour", CASES / "sample.txt")
        self.assertEqual(status, 1)
        self.assertIn("instead of", text)


if __name__ == "__main__":
    unittest.main()
