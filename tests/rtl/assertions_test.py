#!/usr/bin/env python3
"""Each rule of rtl/kit/axi_*_assertions.sv ends a simulation that breaks it, and none of them one that does not.

usage: assertions_test.py ROOT
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

FAULTS = {
    "drop": "channel: valid falls before ready",
    "change": "channel: the payload changes while it waits",
    "reset": "channel: valid after reset",
    "long": "reads: a burst of more than MAX_BEATS",
    "size": "reads: not INCR, or not of whole beats",
    "wrap": "reads: not INCR, or not of whole beats",
    "unaligned": "reads: the address is not that of a beat",
    "cross": "reads: a burst crosses 4 KiB",
    "many": "reads: more than OUTSTANDING bursts",
    "early": "reads: rlast is not at the burst's last beat",
    "write_long": "writes: a burst of more than MAX_BEATS",
    "write_size": "writes: not INCR, or not of whole beats",
    "write_wrap": "writes: not INCR, or not of whole beats",
    "write_unaligned": "writes: the address is not that of a beat",
    "write_cross": "writes: a burst crosses 4 KiB",
    "write_many": "writes: more than OUTSTANDING bursts",
    "write_early": "writes: wlast is not at the burst's last beat",
    "write_response": "writes: a response without its burst",
    "write_exokay": "writes: EXOKAY",
    "exokay": "EXOKAY",
    "response": "lite: a write response without its write",
    "data": "lite: read data without its address",
}


def main(root: pathlib.Path) -> int:
    if shutil.which("verilator") is None:
        print("SKIPPED: verilator is not installed")
        return 77
    with tempfile.TemporaryDirectory() as work:
        sources = [root / "tests/rtl/assertions_bench.sv", *sorted((root / "rtl/kit").glob("axi_*_assertions.sv"))]
        subprocess.run(["verilator", "--binary", "--assert", "-Wno-fatal", "-Mdir", work, "--top-module", "assertions_bench", *map(str, sources)],
                       check=True, stdout=subprocess.DEVNULL)
        failed = 0
        for fault, message in {"none": "no rule was broken", **FAULTS}.items():
            result = subprocess.run([f"{work}/Vassertions_bench", f"+fault={fault}"], capture_output=True, text=True)
            text = result.stdout + result.stderr
            if message not in text or (result.returncode == 0) != (fault == "none"):
                print(f"{fault}: exit status {result.returncode}, not '{message}' but\n{text}")
                failed += 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
