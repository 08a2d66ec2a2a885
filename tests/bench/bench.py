"""Makes the parts of benchmarks importable; the tests are skipped where their packages are missing."""

import importlib.util
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77
PACKAGES = {
    "numpy": "python3-numpy", "PIL": "python3-pil", "skimage": "python3-skimage", "matplotlib": "python3-matplotlib",
    "hmlfc": "python3-dev (and build)",
}


def find(build, *names):
    """Puts bench/common and bench/NAME on the path. Ends the test as skipped where a package is not installed."""
    sys.path[:0] = [str(ROOT / "bench" / name) for name in ("common", *names)]
    sys.path.append(str(Path(build) / "tools" / "python"))
    missing = [package for module, package in PACKAGES.items() if not importlib.util.find_spec(module)]
    if missing:
        print(f"skipped: install the Debian packages {' '.join(missing)}")
        sys.exit(SKIPPED)


def main():
    """Runs the tests of the script. Exit status: 0 all passed, 1 some failed or none ran."""
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
