"""Runs the hmlfc program for the tests of its command line."""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "naive_decoder"))

PROGRAM = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else None
VERSION = sys.argv[2] if len(sys.argv) > 2 else None

DONE, DIFFERENT, USAGE, INPUT, CORRUPT, INCOMPLETE, MISSED = range(7)
INTERNAL, OUT_OF_MEMORY, OUTPUT = 70, 71, 74
SKIPPED = 77


class CliTest(unittest.TestCase):
    """A test with the working folder self.folder, new for each class."""

    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="hmlfc-cli-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prepare()

    @classmethod
    def prepare(cls):
        """Makes the files that the class's tests share."""

    @classmethod
    def run_hmlfc(cls, *arguments, **options):
        command = [PROGRAM, *map(str, arguments)]
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
        return subprocess.run(command, cwd=cls.folder, timeout=240, check=False, **options)

    @classmethod
    def hmlfc(cls, *arguments):
        """Standard output of a run that must succeed and say nothing else."""
        result = cls.run_hmlfc(*arguments)
        if result.returncode != DONE or result.stderr:
            raise AssertionError(
                f"hmlfc {' '.join(map(str, arguments))}: status {result.returncode}, "
                f"{result.stderr.decode()}"
            )
        return result.stdout.decode()

    @classmethod
    def hmlfc_json(cls, *arguments):
        return json.loads(cls.hmlfc(*arguments, "--json"))

    def noted(self, says, *arguments):
        """Standard output of a run that must succeed and say `says` on standard error."""
        result = self.run_hmlfc(*arguments)
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn(says, result.stderr.decode())
        return result.stdout.decode()

    def refused(self, status, *arguments, says=(), **options):
        """A run that must end with `status`, print no result, and name each of `says`."""
        result = self.run_hmlfc(*arguments, **options)
        message = result.stderr.decode()
        self.assertEqual(result.returncode, status, message)
        self.assertFalse(result.stdout)
        self.assertTrue(message.strip())
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, message)
        return message


def main():
    """Runs the tests of the script. Exit: 0 all passed, 1 some failed or none ran, 77 none failed and
    some were skipped; the reasons are printed."""
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    for test, reason in result.skipped:
        print(f"skipped: {test.id()}: {reason}")
    if not result.wasSuccessful() or result.testsRun == 0:
        sys.exit(1)
    sys.exit(SKIPPED if result.skipped else 0)
