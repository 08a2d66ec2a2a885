"""What the tests of `hmlfc conform` share."""

import json
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))

from program import PROGRAM, CliTest, main  # noqa: E402, F401

SUITE = ROOT / "vectors"
FAULTY = ROOT / "tests" / "conform" / "faulty_decoder.py"
INCOMPLETE = 5

os.environ["HMLFC"] = str(PROGRAM)


def manifest():
    return json.loads((SUITE / "manifest.json").read_text())


def faulty(name):
    """The command line of the decoder with one planted fault."""
    return f"{sys.executable} -B {FAULTY} {name} {{input}} -o {{output}}"


# Vectors of the small suite: both profiles, two depths, a refusal when opening and one of a block.
SMALL = (
    "error/magic",
    "error/sign-mode-3",
    "real/cards-main",
    "real/glass-depth10",
    "real/knights-extended",
)


class ConformTest(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.small = cls.folder / "small"
        cls.small.mkdir()
        for group in ("error", "real"):
            (cls.small / group).symlink_to(SUITE / group)
        cls.manifest = manifest()
        cls.manifest["vectors"] = [v for v in cls.manifest["vectors"] if v["id"] in SMALL]
        cls.manifest["count"] = len(SMALL)
        (cls.small / "manifest.json").write_text(json.dumps(cls.manifest))

    def conform(self, dut, *arguments, suite=None, output="report"):
        """Exit status and report of a run on the small suite, or on another."""
        command = ["conform", "--suite", suite or self.small, "--dut", dut, "-o", output, "--json"]
        result = self.run_hmlfc(*command, *arguments)
        self.assertEqual(result.stderr.decode(), "")
        return result.returncode, json.loads(result.stdout)

    def results(self, report):
        """Results by vector of the first decoder."""
        return {result["id"]: result for result in report["runs"][0]["results"]}
