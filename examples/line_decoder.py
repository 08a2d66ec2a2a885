#!/usr/bin/env python3
"""A decoder that speaks the line protocol (docs/line_protocol.md), here around a slow one in Python:

    hmlfc conform --dut 'lines: python3 line_decoder.py' -o report
"""

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tests" / "naive_decoder"))

from block import BlockDecoder  # noqa: E402
from camera import FILTERS, GEOMETRIES, Camera, CameraError  # noqa: E402
from disparity_map import block_of_map  # noqa: E402
from frame import Frame, Shot  # noqa: E402
from frame_record import record_of, record_of_words  # noqa: E402
from frame_trace import trace_shot  # noqa: E402
from light_field import decode_view  # noqa: E402
from opening import Stream  # noqa: E402
from stream_error import StreamError  # noqa: E402
from trace import trace_block  # noqa: E402


def hex_of(samples):
    return "".join(f"{sample & 0xFFFF:04x}" for sample in samples)


def camera_of(words):
    """The Camera of "pu=1.5,pv=0,pz=-2,filter=0"."""
    inputs = {name: float(number) for name, number in (word.split("=") for word in words.split(","))}
    for point, names in (("position", ("pu", "pv", "pz")), ("look_at", ("qu", "qv", "qz"))):
        if names[0] in inputs:
            inputs[point] = tuple(inputs.pop(name) for name in names)
    for name in ("frame_width", "frame_height", "aperture", "filter", "geometry"):
        if name in inputs:
            inputs[name] = int(inputs[name])
    for name, choices in (("filter", FILTERS), ("geometry", GEOMETRIES)):
        if name in inputs:
            inputs[name] = dict(enumerate(choices)).get(inputs[name])
    return Camera(**inputs)


class Server:
    """A method for each request. It returns what follows "ok"."""

    def hello(self, version):
        return "1 view block trace levels record frame disparity pixel"

    def open(self, *words):
        self.decoder = BlockDecoder(Stream(Path(" ".join(words)).read_bytes()))
        h = self.decoder.stream.header
        shape = h.rows, h.cols, h.width, h.height, h.depth, h.chroma_format, h.block_log2, h.tree_height
        return " ".join(map(str, shape))

    def view(self, row, col):
        pixels = decode_view(self.decoder, int(row), int(col))
        return hex_of(sample for line in pixels for pixel in line for sample in pixel)

    def block(self, *place):
        rows = self.decoder.decode(*map(int, place))[-1].sample
        return hex_of(sample for row in rows for sample in row)

    def trace(self, *place):
        records = trace_block(self.decoder, *map(int, place))
        return "\n".join([str(len(records)), *map(json.dumps, records)])

    def record(self, words):
        return " ".join(map(str, record_of(camera_of(words), self.decoder.stream.header).values()))

    def frame(self, stop_level, record):
        shot = self.shot(stop_level, record)
        frame = Frame(shot, shot.pixels.header.depth)
        shot.pixels.require_all()
        counts = (frame.counts[name] for name in ("outside", "blocks_needed", "disparities_looked_up"))
        pixels = hex_of(sample for line in frame.samples for pixel in line for sample in pixel)
        return " ".join([*map(str, counts), pixels])

    def disparity(self, row, col):
        header, side = self.decoder.stream.header, self.decoder.stream.geometry.block
        blocks = [
            block_of_map(self.decoder.stream, int(row), int(col), x // side, y // side)
            for y in range(0, header.height, side)
            for x in range(0, header.width, side)
        ]
        return "".join(f"{disparity & 0xFFFF:04x}{confidence}" for disparity, confidence in blocks)

    def pixel(self, x, y, stop_level, record):
        stages = trace_shot(self.shot(stop_level, record), int(x), int(y))["stages"]
        return "\n".join([str(len(stages)), *map(json.dumps, stages)])

    def shot(self, stop_level, record):
        return Shot(self.decoder.stream, record_of_words(map(int, record.split(","))), int(stop_level))

    def place_of(self, error):
        """The block of a frame's error, by the first view that shows its image; nothing of other errors."""
        if error.place is None:
            return []
        header, (level, row, col, *block) = self.decoder.stream.header, error.place
        return [row * header.cluster_rows**level, col * header.cluster_cols**level, *block]

    def close(self):
        self.decoder = None
        return ""


def serve(server):
    for line in sys.stdin:
        number, request, *words = line.rstrip("\r\n").split(" ")
        try:
            answer = ("ok " + getattr(server, request)(*words)).rstrip()
        except StreamError as error:
            answer = " ".join(["error", error.name, *map(str, server.place_of(error))])
        except CameraError as error:
            answer = f"error {error.name}"
        print(number, answer, flush=True)


if __name__ == "__main__":
    serve(Server())
