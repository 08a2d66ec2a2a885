#!/usr/bin/env python3
"""The check of clock rates passes a fast module and fails with a slow one.

speed_test.py RTL. Exit: 0 so, 1 not, 77 a tool is not installed.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
LIBERTY = Path("/usr/share/qflow/tech/osu035/osu035_stdcells.lib")
FILE = "unit/hmlfc_bise_place.sv"
FAST = "assign group_bit = kind"
SLOW = """wire [13:0] product;
  assign group_bit = product * (product + {8'd0, level_code});
  assign product = kind"""


def check(rtl):
    command = [sys.executable, "-B", rtl / "synth" / "report.py", "speed", "--cells", "--check", "bise_place"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    print(done.stdout)
    return done.returncode


def main(rtl):
    missing = [tool for tool in ("yosys", "sta") if shutil.which(tool) is None]
    if missing or not LIBERTY.exists():
        print("SKIPPED:", *missing, "or the cells of osu035 are not installed")
        return SKIPPED
    with tempfile.TemporaryDirectory() as work:
        copy = Path(work) / "rtl"
        shutil.copytree(rtl, copy)
        if check(copy) != 0:
            return 1
        text = (copy / FILE).read_text()
        assert FAST in text
        (copy / FILE).write_text(text.replace(FAST, SLOW))
        return 0 if check(copy) == 1 else 1


if __name__ == "__main__":
    os.environ.pop("HMLFC_SYNTH_PATH", None)
    sys.exit(main(Path(sys.argv[1])))
