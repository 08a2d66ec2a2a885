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
from light_field import decode_view  # noqa: E402
from opening import Stream  # noqa: E402
from stream_error import StreamError  # noqa: E402
from trace import trace_block  # noqa: E402


def hex_of(samples):
    return "".join(f"{sample & 0xFFFF:04x}" for sample in samples)


class Server:
    """A method for each request. It returns what follows "ok"."""

    def hello(self, version):
        return "1 view block trace levels"

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

    def close(self):
        self.decoder = None
        return ""


def serve(server):
    for line in sys.stdin:
        number, request, *words = line.rstrip("\r\n").split(" ")
        try:
            answer = ("ok " + getattr(server, request)(*words)).rstrip()
        except StreamError as error:
            answer = "error " + error.name
        print(number, answer, flush=True)


if __name__ == "__main__":
    serve(Server())
