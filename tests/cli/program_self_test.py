"""The exit status of a test script tells ctest what became of its tests."""

import subprocess
import sys
import unittest
from pathlib import Path

SCRIPT = """
from program import CliTest, main

class Sample(CliTest):
    {tests}

main()
"""
PASSES = "def test_passes(self): pass"
FAILS = "def test_fails(self): self.fail()"
BREAKS = "def test_breaks(self): raise OSError"
SKIPS = "def test_skips(self): self.skipTest('why')"


class ExitStatus(unittest.TestCase):
    def expect(self, status, *tests):
        """Standard output of a script of `tests`, which must end with `status`."""
        script = SCRIPT.format(tests="\n    ".join(tests))
        result = subprocess.run(
            [sys.executable, "-B", "-c", script],
            cwd=Path(__file__).parent,
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(result.returncode, status, result.stderr)
        return result.stdout

    def test_passed(self):
        self.expect(0, PASSES)

    def test_failed(self):
        self.expect(1, PASSES, FAILS)
        self.expect(1, BREAKS)

    def test_skipped(self):
        output = self.expect(77, PASSES, SKIPS)
        self.assertEqual(output, "skipped: __main__.Sample.test_skips: why\n")

    def test_failed_beside_skipped(self):
        self.expect(1, SKIPS, FAILS)

    def test_nothing_ran(self):
        self.expect(1, "folder = None")


if __name__ == "__main__":
    unittest.main()
