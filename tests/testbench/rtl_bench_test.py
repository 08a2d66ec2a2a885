#!/usr/bin/env python3
"""rtl_bench_test.py TESTBENCH RECORDED STREAM...: rows of a small measurement of the first stream, their comparison with
a report before, and errors; then that pixels a clock of no stream have fallen by 3 % since RECORDED, {stream: {row:
pixels}}, whose successor it prints."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

testbench, recorded, *streams = sys.argv[1:]
stream = streams[0]
SIZE = ["--requests", "24", "--alone", "2"]


def bench(*arguments, code=0):
    done = subprocess.run([testbench, "bench", stream, *SIZE, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stderr if code else done.stdout


report = json.loads(bench("--json"))
rows = {row["name"]: row for row in report[0]["throughput"]}
for name, row in rows.items():
    parts = sum(row["traffic"].values()) - row["traffic"]["again"]
    assert abs(parts - row["bytes"]) < 1e-6, (name, parts, row["bytes"])
    assert 0 < row["busy"] <= 1 and ("row_hits" in row) == ("dram" in name), name
latencies = [rows[f"scan, latency {latency}"]["clocks"] for latency in (0, 1, 20, 60, 100)]
assert latencies == sorted(latencies), latencies
buses = [rows[f"random, dram {bus}, 4 units"]["clocks"] for bus in (64, 16)]
assert buses == sorted(buses), buses

with tempfile.TemporaryDirectory() as work:
    before = pathlib.Path(work) / "before.json"
    changed = report[0]["throughput"]
    was = changed[3]["clocks"]
    changed[3]["clocks"] = 2 * was
    gone = changed.pop(7)["name"]
    before.write_text(json.dumps(report), encoding="utf-8")
    text = bench("--compare", str(before))
    for head in ("random, 81 views", "bytes of a request .*chroma", "warm"):
        assert re.search(head, text), (head, text)
    stem = pathlib.Path(stream).stem
    told = text.splitlines()[-2:]
    assert told == [f"{stem}: {changed[3]['name']}: {2 * was:.1f} -> {was:.1f} clocks (-50.0 %)",
                    f"{stem}: {gone}: not in the report before"], told
    for damaged in ("", "[]x", "{}", '[{"stream": 1}]', '[{"stream": "a", "throughput": [{"name": "b"}]}]'):
        before.write_text(damaged, encoding="utf-8")
        assert "not a report of rtl-bench --json" in bench("--compare", str(before), code=2), damaged
    assert "no-such-file" in bench("--compare", "no-such-file", code=2)

# The clocks of a simulation are the same everywhere, so that no machine is too slow for this.
GATE = ["--requests", "1024", "--only", "scan, latency 20", "scan, latency 100", "--json"]
report = json.loads(subprocess.run([testbench, "bench", *streams, *GATE], capture_output=True, check=True).stdout)
now = {entry["stream"]: {row["name"]: round(row["pixels"], 3) for row in entry["throughput"]} for entry in report}
before = json.loads(pathlib.Path(recorded).read_text(encoding="utf-8"))
print(json.dumps(now, indent=2))
assert {(name, row) for name in now for row in now[name]} == {(name, row) for name in before for row in before[name]}
for name, rows in before.items():
    assert len(rows) == 2, name
    for row, pixels in rows.items():
        assert now[name][row] >= 0.97 * pixels, f"{name}, {row}: {now[name][row]} pixels a clock, recorded are {pixels}"
