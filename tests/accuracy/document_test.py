#!/usr/bin/env python3
"""The tables of docs/accuracy.md are those of the recorded run, and a changed digit is found."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import bench

DOCUMENT = bench.ROOT / "docs" / "accuracy.md"
TABLE_LINE = re.compile(r"(<!-- table run -->\n(?:\|.*\n)+?)\| (.*)")


def check(document):
    command = [sys.executable, "-B", bench.ACCURACY, "--check-document", "--document", document]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class DocumentTest(unittest.TestCase):
    def test_tables_are_those_of_the_recorded_run(self):
        result = check(DOCUMENT)
        self.assertEqual(result.returncode, 0, result.stderr)

    def changed(self, change):
        text = DOCUMENT.read_text(encoding="utf-8")
        other = change(text)
        self.assertNotEqual(other, text)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "accuracy.md"
            path.write_text(other, encoding="utf-8")
            return check(path)

    def test_changed_table_is_found(self):
        result = self.changed(lambda text: TABLE_LINE.sub(r"\1| 0 \2", text, count=1))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("--write-document", result.stderr)

    def test_missing_table_is_found(self):
        result = self.changed(lambda text: text.replace("<!-- table window -->\n", ""))
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("window", result.stderr)


if __name__ == "__main__":
    bench.main()
