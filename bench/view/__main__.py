#!/usr/bin/env python3
"""Frames a second and the time from input to picture of `hmlfc view` in Chromium.

A pointer drags the camera of a light field along a circle, an input every 16 ms, in Chromium without a
window: everything runs on this machine. Frames count when they are drawn on the canvas; the time of each is that from
the oldest input that it shows. With --stream an encoded light field is measured, else Chess is encoded.

Exit status: 0 done, 1 a target is missed (with --check), 2 something cannot be measured.
"""

import argparse
import math
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / name) for name in ("bench/common", "tests/view", "tests/cli")]

from light_field import real_sources
from process import HMLFC, BenchError, hmlfc, run_main, say

RATE, LATENCY = 30, 60  # frames a second; milliseconds, 95th percentile
INTERVAL = 0.016
RADIUS = 0.3  # of the frame's height


def chess(work):
    for source in real_sources(say):
        if source.name == "chess":
            say("encoding Chess")
            hmlfc("encode", source.folder, "-o", work / "chess.hmlfc", "--preset", "fast", "--quality", "60")
            return work / "chess.hmlfc"
    raise BenchError("Chess is not in the folder of light fields; name a --stream")


def drag(page, seconds):
    """Real mouse events around the middle of the frame. Returns their number."""
    left, top, width, height = page.script(
        "const box = document.getElementById('frame').getBoundingClientRect();"
        "return [box.left, box.top, box.width, box.height]")

    def send(kind, angle):
        place = {"x": left + width / 2 + RADIUS * height * math.cos(angle),
                 "y": top + height / 2 + RADIUS * height * math.sin(angle)}
        page.page.execute_cdp_cmd("Input.dispatchMouseEvent", {
            "type": kind, **place, "button": "left", "buttons": 1, "clickCount": 1})

    send("mousePressed", 0)
    begin = next_at = time.monotonic()
    events = 0
    while time.monotonic() - begin < seconds:
        send("mouseMoved", 2 * math.pi * (time.monotonic() - begin) / 4)
        events += 1
        next_at += INTERVAL
        time.sleep(max(0, next_at - time.monotonic()))
    send("mouseReleased", 0)
    return events


def measure(stream, seconds, *options):
    """Figures of one page: inputs, frames, how many of these were coarse or waited for key images, times."""
    import program

    program.PROGRAM = HMLFC
    import page_server
    from browser import Browser, missing

    if missing():
        raise BenchError(missing())
    page_server.PROGRAM = HMLFC
    with tempfile.TemporaryDirectory() as profile, page_server.PageServer(".", stream.resolve(), *options) as server:
        page = Browser(profile)
        try:
            page.open(server.address)
            page.frame()
            drag(page, 1)  # code is compiled
            page.frame()
            page.script("performance.clearMeasures()")
            begin = time.monotonic()
            events = drag(page, seconds)
            took = time.monotonic() - begin
            measures = page.script("return performance.getEntriesByName('input to picture')"
                                   ".map((entry) => [entry.duration, entry.detail.half, entry.detail.keySamples])")
            size = page.script("const c = document.getElementById('frame'); return [c.width, c.height]")
        finally:
            page.end()
    times, coarse, samples = zip(*sorted(measures))
    return {"events": events, "frames": len(times), "coarse": sum(coarse), "waits": sum(s > 0 for s in samples),
            "rate": len(times) / took, "size": size, "median": times[len(times) // 2],
            "p95": times[math.ceil(0.95 * len(times)) - 1]}


def main():
    parser = argparse.ArgumentParser(prog="./run bench view", description=__doc__.splitlines()[0])
    parser.add_argument("--stream", type=Path, help="an .hmlfc file; else Chess is encoded")
    parser.add_argument("--seconds", type=float, default=8, help="of dragging (default 8)")
    parser.add_argument("--check", action="store_true", help=f"fail below {RATE} frames a second or above {LATENCY} ms")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        stream = arguments.stream or chess(Path(work))
        got = measure(stream, arguments.seconds)
        without = measure(stream, arguments.seconds, "--no-ahead")["waits"]
    width, height = got["size"]
    print(f"{got['frames']} frames of {width} x {height} pixels, {got['coarse']} of them coarse, for {got['events']} "
          f"inputs: {got['rate']:.1f} frames a second; input to picture {got['median']:.0f} ms, 95th percentile {got['p95']:.0f} ms")
    print(f"{got['waits']} frames waited for key images; without decoding them ahead, {without}")
    return 1 if arguments.check and (got["rate"] < RATE or got["p95"] > LATENCY) else 0


if __name__ == "__main__":
    run_main("view", main)
