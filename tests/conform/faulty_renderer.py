#!/usr/bin/env python3
"""The renderer in plain Python with a mistake: the columns of views run to the left."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))

import line_decoder  # noqa: E402  (found only now, and where it finds the modules below)
from ray import Ray  # noqa: E402

right = Ray.x
Ray.x = lambda self, col, displacement=0: right(self, 2 * self.record["c0"] - col, displacement)
line_decoder.serve(line_decoder.Server())
