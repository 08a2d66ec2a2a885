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


class ConformTest(CliTest):
    def conform(self, dut, *arguments, output="report"):
        """Exit status and report of a run."""
        command = ["conform", "--suite", SUITE, "--dut", dut, "-o", output, "--json", *arguments]
        result = self.run_hmlfc(*command)
        self.assertEqual(result.stderr.decode(), "")
        return result.returncode, json.loads(result.stdout)

    def results(self, report):
        """Results by vector of the first decoder."""
        return {result["id"]: result for result in report["runs"][0]["results"]}
