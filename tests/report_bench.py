"""Finds a benchmark in Python for its tests, which are skipped where its packages are missing."""

import importlib.util
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SKIPPED = 77
PACKAGES = {
    "numpy": "python3-numpy",
    "PIL": "python3-pil",
    "skimage": "python3-skimage",
    "matplotlib": "python3-matplotlib",
    "hmlfc": "pybind11-dev (and build)",
}


def find(name, *modules):
    """The folder of bench/`name`, whose scripts can be imported from then on. Ends the test as
    skipped where one of `modules`, of PACKAGES, is not installed."""
    folder = ROOT / "bench" / name
    sys.path[:0] = [str(ROOT / "bench" / "common"), str(folder)]
    sys.path.append(str(ROOT / "build/release/tools/python"))
    missing = [PACKAGES[module] for module in modules if not importlib.util.find_spec(module)]
    if missing:
        print(f"skipped: install the Debian packages {' '.join(missing)}")
        sys.exit(SKIPPED)
    return folder


def main():
    """Runs the tests of the script. Exit status: 0 all passed, 1 some failed or none ran."""
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
