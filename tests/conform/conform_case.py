"""What the tests of `hmlfc conform` share."""

import json
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))

from program import PROGRAM, CliTest, main  # noqa: E402, F401

SUITE = ROOT / "vectors"
INCOMPLETE = 5
GOLDEN = "{hmlfc} decode {input} -o {output}"
COARSE = "{hmlfc} decode {input} --levels 1 -o {output}"  # the top of the tree alone: wrong samples

os.environ["HMLFC"] = str(PROGRAM)


def manifest():
    return json.loads((SUITE / "manifest.json").read_text())


# Vectors of the small suite: both profiles, two depths, a refusal when opening and one of a block, and
# the base of both.
SMALL = (
    "error/magic",
    "error/sign-mode-3",
    "real/cards-main",
    "real/glass-depth10",
    "real/knights-extended",
    "syntax/base-main",
)


def make_suite(folder, ids):
    """Makes a suite of some of the vectors in a new folder; its manifest."""
    folder.mkdir()
    for group in {name.split("/")[0] for name in ids}:
        (folder / group).symlink_to(SUITE / group)
    part = manifest()
    part["vectors"] = [vector for vector in part["vectors"] if vector["id"] in ids]
    part["count"] = len(ids)
    (folder / "manifest.json").write_text(json.dumps(part))
    return part


class ConformTest(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.small = cls.folder / "small"
        cls.manifest = make_suite(cls.small, SMALL)

    def conform(self, dut, *arguments, suite=None, output="report"):
        """Exit status and report of a run on the small suite, or on another."""
        command = ["conform", "--suite", suite or self.small, "--dut", dut, "-o", output, "--json"]
        result = self.run_hmlfc(*command, *arguments)
        self.assertEqual(result.stderr.decode(), "")
        return result.returncode, json.loads(result.stdout)

    def results(self, report):
        """Results by vector of the first decoder."""
        return {result["id"]: result for result in report["runs"][0]["results"]}
