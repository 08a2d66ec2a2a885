#!/usr/bin/env python3
"""A wrong width of a structure stops elaboration of the decode unit, with a message that names it.

widths_test.py verilator|yosys RTL

Exit: 0 all were found, 1 not, 77 the tool is not installed.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "rtl" / "kit"))
import file_list  # noqa: E402

SKIPPED = 77
STRUCTURES = ["LEVEL", "IMAGE_TILES", "IMAGE_REFERENCES", "IMAGE", "JOB", "MOTION", "FLOW", "PENDING"]


def elaborate(tool, package, rtl):
    """What the tool says of the unit with this package."""
    files = [package, *file_list.modules(rtl)]
    command = ["verilator", "--lint-only", "-Wall", f"-I{rtl}", rtl / "waivers.vlt", *files, "--top-module", "hmlfc_decode_unit"]
    if tool == "yosys":
        command = ["yosys", "-q", "-p", f"read_verilog -sv -defer -I{rtl} {' '.join(map(str, files))}",
                   "-p", "hierarchy -check -top hmlfc_decode_unit"]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False).stdout


def main():
    tool, rtl = sys.argv[1], Path(sys.argv[2])
    if not shutil.which(tool):
        print(f"{tool} is not installed")
        return SKIPPED
    text = (rtl / "hmlfc_pkg.sv").read_text()
    missed = 0
    with tempfile.TemporaryDirectory() as folder:
        package = Path(folder) / "hmlfc_pkg.sv"
        for name in STRUCTURES:
            wrong, count = re.subn(rf"(int {name}_BITS = [^;]+);", r"\1 + 1;", text)
            package.write_text(wrong)
            message = f"{name}_BITS is not the width of {name.lower()}_t"
            if count != 1 or message not in elaborate(tool, package, rtl):
                print(f"not found: {name}_BITS + 1")
                missed += 1
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
