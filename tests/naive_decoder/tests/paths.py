"""Makes the modules of the naive decoder and those of tests/cli importable. Import it first."""

import sys
from pathlib import Path

DECODER = Path(__file__).resolve().parents[1]
CLI_TESTS = DECODER.parent / "cli"
sys.path[:0] = [str(DECODER), str(CLI_TESTS)]
