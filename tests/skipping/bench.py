"""The skipping bench for its tests."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report_bench import ROOT, find, main  # noqa: E402, F401

SKIPPING = find("skipping", "numpy", "PIL", "matplotlib")
