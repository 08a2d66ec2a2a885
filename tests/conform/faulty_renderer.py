#!/usr/bin/env python3
"""The renderer in plain Python with a mistake: the columns of views run to the left. Arguments name OTHERS."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))

import line_decoder  # noqa: E402  (found only now, and where it finds the modules below)
from ray import Ray  # noqa: E402
from stream_error import require  # noqa: E402

right = Ray.x
Ray.x = lambda self, col, displacement=0: right(self, 2 * self.record["c0"] - col, displacement)
server = line_decoder.Server()
record, disparity = server.record, server.disparity
OTHERS = {
    "number-42": ("record", lambda words: record(words) + " 42"),
    "silent": ("pixel", lambda *words: "0"),
    "failing": ("pixel", lambda *words: require(False, "bad_mode")),
    "ending": ("pixel", lambda *words: sys.exit()),
    "map": ("disparity", lambda *view: "7" + disparity(*view)[1:]),
}
for name in sys.argv[1:]:
    setattr(server, *OTHERS[name])
line_decoder.serve(server)
