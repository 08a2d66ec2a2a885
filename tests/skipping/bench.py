"""Finds the skipping bench for its tests, which are skipped where its packages are missing."""

import importlib.util
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPING = ROOT / "bench" / "skipping"
SKIPPED = 77
PACKAGES = {"numpy": "python3-numpy", "PIL": "python3-pil", "matplotlib": "python3-matplotlib"}

sys.path[:0] = [str(ROOT / "bench" / "common"), str(SKIPPING)]
MISSING = [package for name, package in PACKAGES.items() if not importlib.util.find_spec(name)]
if MISSING:
    print(f"skipped: install the Debian packages {' '.join(MISSING)}")
    sys.exit(SKIPPED)


def main():
    """Runs the tests of the script. Exit status: 0 all passed, 1 some failed or none ran."""
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
