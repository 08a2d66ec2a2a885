#!/usr/bin/env python3
"""checker_unit_test.py TESTBENCH HMLFC ROOT: hmlfc_checker.sv bound to the pins of the Verilated decode unit.

Whole streams of both profiles and all block sizes pass at all stages, and so do damaged streams and such that are refused;
a single bit of the checker's copy of the stream is noticed, at the block, level and stage whose value it changes.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

testbench, hmlfc = sys.argv[1:3]
root = Path(sys.argv[3])
device = root / "testbench" / "checker" / "hmlfc_decode_unit.device"
names = ("real/cards-main", "real/knights-extended", "real/glass-depth10", "syntax/blocks-2-420")
streams = [root / "vectors" / f"{name}.hmlfc" for name in names]


def checked(expected, stream, *options):
    """Exit status and text of a run on `stream` that the checker compares with the stream `expected`."""
    command = [testbench, "check", stream, "--output", folder, *options]
    plusargs = f"+hmlfc_checker_stream={expected} +hmlfc_checker_device={device}"
    done = subprocess.run(command, env=dict(os.environ, HMLFC_RTL_PLUSARGS=plusargs), text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout


def number(pattern, text):
    return int(re.search(pattern, text)[1])


def last_bit(stream, plane, block, name):
    """The address in bits of the last field `name` of a block of view 1,2 at level 0; of a sequence, that of its first value."""
    command = [hmlfc, "inspect", stream, "--view", "1,2", "--plane", plane, "--block", block, "--json"]
    report = json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)
    field = [field for field in report["levels"][-1]["fields"] if field["name"] == name][-1]
    return field["byte"] * 8 + field["bit"]


with tempfile.TemporaryDirectory() as folder:
    for stream in streams:
        code, text = checked(stream, stream, "--views", "all")
        assert code == 0 and "hmlfc_checker: passed" in text, text
        records = number(r"stage records +(\d+)", text)
        assert number(r"compared (\d+)\n    residual", text) == records == number(r"    sample +(\d+)", text) > 0, text
        assert "skipped" not in text, text

    for name in ("reference-block", "mask-one-outside", "disparity-range", "top-range", "field-depth-13"):
        stream = root / "vectors" / "error" / f"{name}.hmlfc"
        code, text = checked(stream, stream)
        statuses = {int(status) for status in re.findall(r"(?m)^  status (\d+) ", text)}
        assert code == 0 and "hmlfc_checker: passed" in text and statuses - {0}, text

    stream = streams[0]
    copy = Path(folder) / "changed.hmlfc"
    cases = (("Y", "3,3", "value", "residual"), ("Cg", "1,0", "dy", "reference"), ("Co", "1,0", "sign", "prediction"))
    for plane, block, name, stage in cases:
        at = last_bit(stream, plane, block, name)
        changed = bytearray(stream.read_bytes())
        changed[at >> 3] ^= 1 << (at & 7)
        copy.write_bytes(changed)
        code, text = checked(copy, stream, "--views", "all")
        assert code != 0 and re.search(rf"difference 1 at clock \d+: stage: {stage}\n", text), text
        assert f"place      level 0 image 1,2 plane {plane} block {block}, stage {stage} (" in text, text
        print(text)
