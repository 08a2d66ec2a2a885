#!/usr/bin/env python3
"""dpi_test.py BENCH HMLFC STREAM: the blocks that SystemVerilog gets from the golden model are those of
`hmlfc inspect`."""

import json
import re
import subprocess
import sys

bench, hmlfc, stream = sys.argv[1:]
ROW, COL, PLANES = 1, 2, ("Y", "Co", "Cg")


def output(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout


def inspected(plane, block):
    """The samples of the block at level 0, row by row."""
    place = ["--view", f"{ROW},{COL}", "--plane", plane, "--block", block]
    report = json.loads(output(hmlfc, "inspect", stream, *place, "--json"))
    return [value for row in report["levels"][-1]["stages"]["sample"]["values"] for value in row]


compared = 0
for number, plane in enumerate(PLANES):
    text = output(bench, f"+stream={stream}", f"+row={ROW}", f"+col={COL}", f"+plane={number}")
    blocks = re.findall(r"(?m)^block (\d+,\d+):((?: -?\d+)+)$", text)
    count = int(re.search(r"(?m)^(\d+) blocks, 0 errors$", text).group(1))
    assert count == len(blocks) > 0, text
    for place, values in blocks[:: max(1, len(blocks) // 8)]:
        assert [int(value) for value in values.split()] == inspected(plane, place), (plane, place)
        compared += 1
missing = output(bench, "+stream=no-such-file")
assert "error -1" in missing, missing
print(f"{compared} blocks compared")
