#!/usr/bin/env python3
"""The tables of docs/skipping.md and docs/scale.md are those of the recorded run, and a changed digit
is found."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import bench

NAMES = ("skipping.md", "scale.md")


def check(folder):
    command = [sys.executable, "-B", bench.SKIPPING, "--check-document", "--documents", folder]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class DocumentTest(unittest.TestCase):
    def test_tables_are_those_of_the_recorded_run(self):
        result = check(bench.ROOT / "docs")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_changed_table_is_found(self):
        for name in NAMES:
            with tempfile.TemporaryDirectory() as folder:
                for copied in NAMES:
                    shutil.copy(bench.ROOT / "docs" / copied, folder)
                path = Path(folder) / name
                path.write_text(path.read_text(encoding="utf-8").replace("| cards |", "| card |", 1),
                                encoding="utf-8")
                result = check(folder)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn(name, result.stderr)


if __name__ == "__main__":
    bench.main()
