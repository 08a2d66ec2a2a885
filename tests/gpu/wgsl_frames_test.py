#!/usr/bin/env python3
"""The renderer in WGSL, in Chromium on its own software device, against the frames of the conformance suite.

usage: wgsl_frames_test.py KERNELS SUITE [PATTERN]

Streams are opened by the module in WebAssembly, which decodes their key images (EXT-6), reads their disparities and
makes frame records. Every frame: its pixels, counts or error are those of the suite; every camera that a page can give:
its record.

Exit: 0 good, 1 not, 77 skipped: no browser, no WebGPU, or no WGSL or module was built.
"""

import fnmatch
import json
import sys
from pathlib import Path

from wgsl_test import SKIPPED, Page, checked, error_numbers

from browser import missing

CAMERA = {"frame_width": "width", "frame_height": "height", "pu": "u", "pv": "v", "pz": "z", "qu": "atU", "qv": "atV",
          "qz": "atZ", "focus": "focus", "aperture": "aperture", "filter": "filter", "geometry": "geometry"}


class FramesPage(Page):
    module = "wgsl_frames.js"


def frames_by_stream(suite, pattern):
    numbers, streams = error_numbers(), {}
    for frame in json.loads((suite / "manifest.json").read_text())["frames"]:
        if "record" in frame and fnmatch.fnmatch(frame["id"], pattern):
            streams.setdefault(frame["input"]["file"], []).append({
                "id": frame["id"], "record": frame["record"], "stopLevel": frame.get("stop_level", 0),
                "error": numbers.get(frame["expect"].get("error"), 0), "sha256": frame["frame"].get("sha256"),
                "needed": frame["frame"]["blocks_needed"], "lookedUp": frame["frame"]["disparities_looked_up"],
                "camera": frame["camera"]})
    return streams


def camera_of(frame):
    """The camera as a page gives it, or None."""
    camera = frame["camera"]
    if not set(camera) <= set(CAMERA) or "pu" not in camera:
        return None
    place = {"atU": camera["pu"], "atV": camera["pv"], "atZ": camera["pz"] + 1, "focus": 0, "aperture": 0, "filter": 2,
             "geometry": 0, "width": frame["record"][0], "height": frame["record"][1]}
    return {**place, **{CAMERA[name]: value for name, value in camera.items()}}


def wrong_records(page, address, frames):
    cameras = [(frame, camera_of(frame)) for frame in frames if camera_of(frame)]
    records = page.call("records", address, [camera for _, camera in cameras])
    return [f"{frame['id']}: the record of its camera is {record}" for (frame, _), record in zip(cameras, records)
            if record != frame["record"]]


def check(page, streams):
    found, count = [], 0
    for name, frames in streams.items():
        found += page.call("wrongFrames", f"/suite/{name}", frames)
        found += wrong_records(page, f"/suite/{name}", frames)
        count += len(frames)
    print(f"{count} frames of {len(streams)} streams, {len(found)} differences")
    return found


def main():
    kernels, suite, pattern = Path(sys.argv[1]), Path(sys.argv[2]), (*sys.argv[3:], "*")[0]
    if missing() or not (kernels / "hmlfc_stream.wasm").exists():
        print(f"skipped: {missing() or 'no module was built'}")
        return SKIPPED
    names = frames_by_stream(suite, pattern)
    return checked(FramesPage, dict(wgsl=kernels, suite=suite), lambda page: check(page, names), module="wgsl_page.js")


if __name__ == "__main__":
    sys.exit(main())
