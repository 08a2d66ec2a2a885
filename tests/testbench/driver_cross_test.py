#!/usr/bin/env python3
"""The driver compiled for another processor says, fills and writes what it does here.

driver_cross_test.py ROOT VECTORS PROCESSOR: with PROCESSOR-linux-gnu-gcc and qemu-PROCESSOR.
Exit: 0 so, 1 not, 77 one of them is missing.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

WARNINGS = "-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wcast-qual -Wcast-align=strict -Werror".split()


def said(root, streams, compiler, runner, work):
    """What the probe prints, built by `compiler`."""
    probe = f"{work}/{compiler}"
    files = [path for path in sorted((root / "rtl/driver").glob("*.c")) if path.stem != "hmlfc_openjpeg"]
    subprocess.run([compiler, "-std=c11", "-O2", "-static", *WARNINGS, f"-I{root}/rtl", "-o", probe,
                    root / "tests/testbench/driver_probe.c", *files], check=True)
    return subprocess.run([*runner, probe, *streams], check=True, capture_output=True, text=True).stdout


def main(root, vectors, processor):
    tools = f"{processor}-linux-gnu-gcc", f"qemu-{processor}"
    if missing := [tool for tool in tools if shutil.which(tool) is None]:
        print("SKIPPED:", *missing, "is not installed")
        return 77
    streams = sorted(path for path in Path(vectors).rglob("*.hmlfc") if path.stat().st_size < 1 << 20)[::4]
    with tempfile.TemporaryDirectory() as work:
        here = said(Path(root), streams, "cc", [], work)
        there = said(Path(root), streams, tools[0], [tools[1]], work)
    assert here.count("descriptors") > 50, here
    assert here == there, [pair for pair in zip(here.splitlines(), there.splitlines()) if pair[0] != pair[1]][:5]
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
