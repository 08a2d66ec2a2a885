#!/usr/bin/env python3
"""Plants unreached lines and branches: report.py must count and name each."""

import json
import tempfile
import unittest
from pathlib import Path

import report

SOURCE = "int half(int x) {\n  if (x < 0) return -1;\n  return x / 2;\n}\n"


def line(number, count, *branches):
    """A line as gcovr gives it."""
    counted = [{"count": branch} for branch in branches]
    return {"line_number": number, "count": count, "branches": counted, "gcovr/noncode": False}


class Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hmlfc-coverage-")
        self.addCleanup(folder.cleanup)
        self.model = Path(folder.name)
        (self.model / "bits").mkdir()
        (self.model / "bits/half.cpp").write_text(SOURCE)
        self.files = {"bits/half.cpp": [line(1, 3), line(2, 3, 0, 3), line(3, 0)]}

    def explain(self, missed, *lines):
        path = self.model / "reasons.json"
        path.write_text(json.dumps([{"reason": "why", "lines": {"bits/half.cpp": lines}}]))
        return report.explain(self.model, missed, path)

    def test_counts(self):
        rows, lines, branches = report.summarise(self.files, {})
        self.assertEqual(rows, [("bits/half.cpp", 3, 2, 2, 1)])
        self.assertEqual((lines, branches), ([("bits/half.cpp", 3)], [("bits/half.cpp", 2)]))

    def test_what_is_not_part_of_decoding(self):
        self.assertEqual(report.summarise(self.files, {"bits/half.cpp": None}), ([], [], []))
        rows, lines, _ = report.summarise(self.files, {"bits/half.cpp": {3}})
        self.assertEqual((rows[0][1], lines), (2, []))

    def test_missed_lines_are_explained_or_open(self):
        missed = [("bits/half.cpp", 2), ("bits/half.cpp", 3)]
        explained, open_places, stale = self.explain(missed, "return x / 2;")
        self.assertEqual(explained, [("bits/half.cpp", 3, "return x / 2;", "why")])
        self.assertEqual(open_places, [("bits/half.cpp", 2, "if (x < 0) return -1;")])
        self.assertEqual(stale, [])

    def test_stale_reason(self):
        explained, open_places, stale = self.explain([], "return x / 2;")
        self.assertEqual((explained, open_places, stale), ([], [], [("bits/half.cpp", "return x / 2;")]))


if __name__ == "__main__":
    unittest.main()
