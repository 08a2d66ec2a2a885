#!/usr/bin/env python3
"""Bytes, requests and time of frames of a stream at an http:// address, by the delay of its server.

A server of this machine waits before each answer. `hmlfc render` draws frames along a path from the address: the
first, with opening the stream, by a program of its own, which is timed as a whole; the others by a program that keeps
what it has, as mean of a frame. The stream of 64 GiB is the first one with a hole in its TILE section.

Exit status: 0 done, 1 the first frame of the stream of 64 GiB fetches too much, 2 something cannot be measured.
"""

import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / name) for name in ("bench/common", "tests/support")]

from process import hmlfc, hmlfc_json, run_main, say
from range_server import RangeServer
from report import Report, columns
from sparse import write_with_hole

PROFILES = {"main": ["--profile", "main"], "extended": ["--preset", "fast"]}
DELAYS = (0, 20, 80)  # ms
LARGE, LARGE_BYTES = 1 << 36, 1_000_000  # bytes of the hole; the most that the first frame may fetch
# --quick: of a view of 9 x 9, of a frame, frames along the path orbit
SIZES = {False: ("96x64", "64x64", 16), True: ("24x16", "16x12", 2)}


def render(server, work, frames, size):
    """(What `hmlfc render` says of its frames, ms of the whole program)."""
    began = time.perf_counter()
    said = hmlfc_json("render", server.address, "-o", work / "frames", "--path", "orbit", "--frames", frames, "--size", size)
    return said["frames"], 1000 * (time.perf_counter() - began)


def row(stream, name, delay, options, work):
    """Bytes, requests, rounds and ms of the first frame, and the mean of the next ones."""
    _, size, count = SIZES[options.quick]
    with RangeServer(stream, delay / 1000) as server:
        _, first_ms = render(server, work, 1, size)
    with RangeServer(stream, delay / 1000) as server:
        frames, _ = render(server, work, count, size)
    first, *others = ({**frame["fetched"], "ms": 1000 * frame["seconds"]} for frame in frames)
    made = {"stream": name, "file_bytes": stream.stat().st_size, "delay": delay}
    made |= {f"first_{key}": first[key] for key in first} | {"first_ms": first_ms}
    return made | {f"next_{key}": sum(frame[key] for frame in others) / len(others) for key in first}


def measure(options, work):
    """Groups streams and, where the stream of 64 GiB costs too much, failed."""
    views = work / "views"
    hmlfc("synth", "--scene", "cards", "--grid", "9x9", "--size", SIZES[options.quick][0], "-o", views)
    rows, streams = [], {}
    for name, coding in PROFILES.items():
        streams[name] = work / f"{name}.hmlfc"
        hmlfc("encode", views, "-o", streams[name], *coding)
        for delay in DELAYS:
            say(f"profile {name}, {delay} ms")
            rows.append(row(streams[name], name, delay, options, work))
    large = work / "large.hmlfc"
    write_with_hole(streams["main"], large, LARGE)
    rows.append(row(large, "main, 64 GiB", DELAYS[-1], options, work))
    fetched = rows[-1]["first_bytes"]
    if fetched > LARGE_BYTES:
        say(f"the first frame of the stream of 64 GiB fetches {fetched} bytes, more than {LARGE_BYTES}")
    return {"streams": rows, "failed": rows[-1:] if fetched > LARGE_BYTES else []}


def tables(results):
    parts = []
    for title, part in (("first frame: ", "first"), ("next frames: ", "next")):
        parts += [(f"{title}KiB", lambda row, part=part: f"{row[f'{part}_bytes'] / 1024:.0f}"),
                  ("requests", f"{{{part}_requests:.0f}}"), ("rounds", f"{{{part}_rounds:.1f}}"), ("ms", f"{{{part}_ms:.0f}}")]
    rows = columns(results["streams"], ("stream", "{stream}"), ("KiB", lambda row: row["file_bytes"] >> 10),
                   ("delay ms", "{delay}"), *parts)
    return [("Frames of a stream at an address", rows)]


if __name__ == "__main__":
    run_main("remote", Report("remote", __doc__, "small views and frames", measure, tables).main)
