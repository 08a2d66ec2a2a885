#!/usr/bin/env python3
"""rtl_bench_test.py TESTBENCH RECORDED STREAM...: rows of a small measurement of the first stream, their comparison with
a report before, and errors; then that no stream's pixels a clock have fallen by 3 % since the report RECORDED."""

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

GATE = ["--requests", "1024", "--only", "scan, latency 20", "scan, latency 100", "--json"]
now = json.loads(subprocess.run([testbench, "bench", *streams, *GATE], capture_output=True, check=True).stdout)
before = json.loads(pathlib.Path(recorded).read_text(encoding="utf-8"))
assert len(now) == len(before) == 4
for old, new in zip(before, now):
    assert old["stream"] == new["stream"] and len(old["throughput"]) == len(new["throughput"]) == 2
    for was, row in zip(old["throughput"], new["throughput"]):
        assert row["name"] == was["name"] and row["pixels"] >= 0.97 * was["pixels"], \
            f"{old['stream']}, {row['name']}: {row['pixels']:.3f} pixels a clock, recorded are {was['pixels']:.3f}"
