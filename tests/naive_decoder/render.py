#!/usr/bin/env python3
"""Renders a frame of an .hmlfc file slowly, by docs/rendering.md and docs/specification.md alone.

    render.py FILE SHOT -o FRAME               the frame as FRAME: a PPM file if it ends in .ppm, else raw samples
    render.py FILE SHOT --trace X,Y            the stages of one pixel, as JSON

SHOT is JSON, an object of inputs of CAM-3 by their names: {"position": [0.4, 0.2, 0], "focus": 1.5}. Or it is
{"record": [41 integers], "stop_level": 0}. With -o the counts are printed as JSON.

Exit status: 0 done; 2 wrong arguments, or a camera that is not valid: the input at fault is on standard error;
3 FILE cannot be read; 4 the stream is not valid: the error's name in annex A is on standard error, and after it
level, row, column, plane, column and row of the block that has it, if it is one of a block.
"""

import argparse
import json
import pathlib
import sys

from camera import Camera, CameraError
from frame import render
from frame_trace import trace
from picture_files import ppm_bytes, raw_bytes
from stream_error import StreamError


def shot_of_json(value):
    """(camera or words of a record, stop level) of SHOT; ValueError or TypeError if it is none."""
    if "record" in value:
        words, stop_level = value["record"], value.get("stop_level", 0)
        if not value.keys() <= {"record", "stop_level"} or len(words) != 41:
            raise ValueError("a record has 41 integers")
        return words, stop_level
    return Camera(**value), value.get("stop_level", 0)


def parse_arguments(arguments):
    """The command line."""
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("shot")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="file for the frame")
    parser.add_argument("--trace", metavar="X,Y", help="column and row of a pixel of the frame")
    parsed = parser.parse_args(arguments)
    if (parsed.output is None) == (parsed.trace is None):
        parser.error("either --output or --trace is needed")
    try:
        parsed.shot = shot_of_json(json.loads(parsed.shot))
        parsed.trace = parsed.trace and [int(number) for number in parsed.trace.split(",", 1)]
    except (TypeError, ValueError) as error:
        parser.error(str(error))
    return parsed


def main(arguments):
    """Returns the exit status."""
    options = parse_arguments(arguments)
    shot, stop_level = options.shot
    try:
        data = options.file.read_bytes()
    except OSError as error:
        print(error, file=sys.stderr)
        return 3
    try:
        if options.trace:
            print(json.dumps(trace(data, shot, *options.trace, stop_level)))
            return 0
        frame = render(data, shot, stop_level)
    except StreamError as error:
        print(error.name, *(error.place or ()), file=sys.stderr)
        return 4
    except (CameraError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    as_bytes = ppm_bytes if options.output.suffix == ".ppm" else raw_bytes
    options.output.write_bytes(as_bytes(frame.samples, frame.depth))
    print(json.dumps(frame.counts))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
