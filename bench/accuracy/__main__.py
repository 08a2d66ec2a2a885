#!/usr/bin/env python3
"""Time against error: what encodings and rendered frames cost, and how wrong they are.

Measures the light fields of HMLFC_DATA_DIR and the built-in scenes by studies; docs/accuracy.md says
what each measures. With --record a part of the studies or light fields replaces what it measured.

Exit status: 0 done, 1 a value is not that of the recorded run, 2 something cannot be measured.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

try:
    from measure import measure
    from process import run_main
    from report import Report
    from studies import NAMES
    from tables import pictures, tables
except ImportError as error:
    names = "python3-numpy, python3-matplotlib and python3-skimage"
    sys.exit(f"{error}: install the Debian packages {names}")


def add_options(parser):
    parser.add_argument("--studies", nargs="+", choices=NAMES, metavar="STUDY", default=list(NAMES),
                        help="of: " + " ".join(NAMES) + " (default all)")
    parser.add_argument("--light-field", nargs="+", metavar="NAME", default=[],
                        help="of: chess antinous knights synth-cards synth-knights synth-glass synth-flat synth-noise "
                             "(default all)")


if __name__ == "__main__":
    run_main("accuracy", Report("accuracy", __doc__, "two small scenes, fewer points; compared with nothing", measure,
                                tables, ("light_field", "coding", "frame"), "Time against error", pictures, add_options).main)
