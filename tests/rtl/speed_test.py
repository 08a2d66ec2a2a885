#!/usr/bin/env python3
"""A module meets the clock rate that rtl/synth/report.py asks of it.

speed_test.py RTL. Exit: 0 so, 1 not, 77 a tool is not installed.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
LIBERTY = Path("/usr/share/qflow/tech/osu035/osu035_stdcells.lib")


def main(rtl):
    missing = [tool for tool in ("yosys", "sta") if shutil.which(tool) is None]
    if missing or not LIBERTY.exists():
        print("SKIPPED:", *missing, "or the cells of osu035 are not installed")
        return SKIPPED
    command = [sys.executable, "-B", rtl / "synth" / "report.py", "speed", "--cells", "--check", "bise_place"]
    return subprocess.run(command, check=False).returncode


if __name__ == "__main__":
    os.environ.pop("HMLFC_SYNTH_PATH", None)
    sys.exit(main(Path(sys.argv[1])))
