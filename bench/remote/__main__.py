#!/usr/bin/env python3
"""Bytes, requests and time of frames of a stream at an http:// address, by the delay of its server.

A server of this machine waits before each answer. `hmlfc render` draws frames along a path from the address: the
first, with opening the stream, by a program of its own, which is timed as a whole; the others by a program that keeps
what it has, as mean of a frame. The stream of 64 GiB is the first one with a hole in its TILE section.

Exit status: 0 done, 1 a target is missed, 2 something cannot be measured.
"""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / name) for name in ("bench/common", "bench/skipping", "tests/support")]

import sparse
from process import HMLFC, machine, require, run, run_main, say
from range_server import RangeServer

PROFILES = {"main": ["--profile", "main"], "extended": ["--preset", "fast"]}
DELAYS = (0, 20, 80)  # ms
LARGE, LARGE_BYTES = 1 << 36, 1_000_000  # bytes of the hole; the most that the first frame may fetch


def render(server, frames, options):
    began = time.perf_counter()
    output = run([options.program, "render", server.address, "-o", options.work / "frames", "--path", "orbit", "--frames", frames,
                  "--size", options.frame, "--json"])[0]
    return json.loads(output)["frames"], 1000 * (time.perf_counter() - began)


def measure(stream, name, delay, options):
    with RangeServer(stream, delay / 1000) as server:
        _, first_ms = render(server, 1, options)
    with RangeServer(stream, delay / 1000) as server:
        frames, _ = render(server, options.frames, options)
    first, *others = ({**frame["fetched"], "ms": 1000 * frame["seconds"]} for frame in frames)
    mean = {key: sum(frame[key] for frame in others) / len(others) for key in first}
    return {"stream": name, "file": stream.stat().st_size, "delay": delay, "first": {**first, "ms": first_ms}, "next": mean}


def results(options):
    require("remote", options.program)
    views = options.work / "views"
    run([options.program, "synth", "--scene", "cards", "--grid", "9x9", "--size", options.size, "-o", views])
    rows, streams = [], {}
    for name, coding in PROFILES.items():
        streams[name] = options.work / f"{name}.hmlfc"
        say(f"encoding in profile {name}")
        run([options.program, "encode", views, "-o", streams[name], *coding])
        for delay in DELAYS:
            say(f"profile {name}, {delay} ms")
            rows.append(measure(streams[name], name, delay, options))
    large = options.work / "large.hmlfc"
    sparse.write_with_hole(streams["main"], large, LARGE)
    say("64 GiB")
    rows.append(measure(large, "main, 64 GiB", DELAYS[-1], options))
    return {"machine": machine(), "rows": rows}


def table(rows):
    """One row a stream and delay: the first frame, then the mean of the others."""
    yield "| stream | KiB | delay ms | first frame: KiB | requests | rounds | ms | next frames: KiB | requests | rounds | ms |"
    yield "|---|---|---|---|---|---|---|---|---|---|---|"
    for row in rows:
        parts = [cell for part in (row["first"], row["next"]) for cell in (
            f"{part['bytes'] / 1024:.0f}", f"{part['requests']:.0f}", f"{part['rounds']:.1f}".removesuffix(".0"),
            f"{part['ms']:.0f}")]
        yield f"| {row['stream']} | {row['file'] >> 10} | {row['delay']} | {' | '.join(parts)} |"


def main():
    parser = argparse.ArgumentParser(prog="./run bench remote", description=__doc__.splitlines()[0])
    parser.add_argument("--size", default="96x64", help="of a view of 9 x 9 (default 96x64)")
    parser.add_argument("--frame", default="64x64", help="of a frame (default 64x64)")
    parser.add_argument("--frames", type=int, default=16, help="along the path orbit, at least 2 (default 16)")
    parser.add_argument("--program", type=Path, default=HMLFC, help="hmlfc (default: that of ./run)")
    parser.add_argument("--json", action="store_true", help="print JSON")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        options.work = Path(work)
        got = results(options)
    print(json.dumps(got, indent=2) if options.json else "\n".join(table(got["rows"])))
    fetched = got["rows"][-1]["first"]["bytes"]
    if fetched > LARGE_BYTES:
        say(f"the first frame of the stream of 64 GiB fetches {fetched} bytes, more than {LARGE_BYTES}")
    return int(fetched > LARGE_BYTES)


if __name__ == "__main__":
    run_main("remote", main)
