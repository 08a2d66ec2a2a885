"""What the tests of `hmlfc primitives` share."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))

from program import DIFFERENT, DONE, USAGE, CliTest, main  # noqa: E402, F401

from answers import ANSWERS, answered  # noqa: E402, F401


class PrimitivesTest(CliTest):
    def cases(self, name, *options):
        """The lines of gen."""
        return self.hmlfc("primitives", "gen", name, *options).splitlines()

    def check(self, name, lines, *options):
        """(exit status, lines printed) of check."""
        text = "".join(line + "\n" for line in lines)
        result = self.run_hmlfc("primitives", "check", name, *options, input=text.encode())
        self.assertEqual(result.stderr, b"")
        return result.returncode, result.stdout.decode().splitlines()

    def agree(self, name, *options):
        """The lines with the naive decoder's results, which are those of the golden model."""
        lines = [answered(name, case) for case in self.cases(name, *options)]
        self.assertEqual(self.check(name, lines, *options), (DONE, [f"{name}: {len(lines)} cases, all right"]))
        return lines
