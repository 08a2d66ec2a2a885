"""What the tests of the package hmlfc share: the program to compare with, and streams."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [sys.argv[2], str(ROOT / "tests" / "cli"), str(ROOT / "tests" / "support")]

import numpy as np  # noqa: E402
from pictures import read_png  # noqa: E402
from program import CliTest, main  # noqa: E402, F401
from range_server import RangeServer  # noqa: E402, F401

import hmlfc  # noqa: E402, F401

VECTORS = ROOT / "vectors"
STREAM = VECTORS / "real" / "knights-extended.hmlfc"
DEEP = VECTORS / "real" / "glass-depth10.hmlfc"


def needs_addresses(test):
    """The test, skipped where the package was built without libcurl."""

    def run(self):
        with self.assertRaises(OSError) as raised:
            hmlfc.open("http://0.0.0.0:1/")
        return self.skipTest("no libcurl") if "without libcurl" in str(raised.exception) else test(self)

    return run


def picture(file):
    """The samples of a PNG file, (height, width, 3), as they are stored."""
    found = read_png(file)
    return np.array(found.samples, np.uint16).reshape(found.height, found.width, 3)


def read_pfm(file):
    """The values of a PFM file, the top row first."""
    kind, size, scale, data = file.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert kind == b"Pf"
    return np.frombuffer(data, "<f4" if float(scale) < 0 else ">f4").reshape(height, width)[::-1]
