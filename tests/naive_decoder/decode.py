#!/usr/bin/env python3
"""Decodes an .hmlfc file slowly, by docs/specification.md alone.

    decode.py FILE -o FOLDER [--ppm]           all views into FOLDER/views.raw, and as RR_CC.ppm
    decode.py FILE --trace R,C,PLANE,BX,BY     the stages of one block, one JSON record a line

Exit status: 0 done; 2 wrong arguments; 3 FILE cannot be read; 4 the stream is not valid: the error's
name in annex A is on standard error.
"""

import argparse
import json
import pathlib
import sys

from block import BlockDecoder
from light_field import decode_view
from opening import Stream
from picture_files import ppm_bytes, raw_bytes
from stream_error import StreamError
from trace import PLANE_NAMES, trace_block


def parse_arguments(arguments):
    """The command line."""
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder for the views")
    parser.add_argument("--ppm", action="store_true", help="write each view as a PPM file, too")
    parser.add_argument("--trace", metavar="R,C,PLANE,BX,BY", help="PLANE is Y, Co or Cg, or its number")
    parsed = parser.parse_args(arguments)
    if (parsed.output is None) == (parsed.trace is None):
        parser.error("either --output or --trace is needed")
    if parsed.trace is not None:
        try:
            row, col, plane, block_x, block_y = parsed.trace.split(",")
            number = [*PLANE_NAMES, "0", "1", "2"].index(plane) % len(PLANE_NAMES)
            parsed.trace = int(row), int(col), number, int(block_x), int(block_y)
        except ValueError:
            parser.error("--trace takes R,C,PLANE,BX,BY")
    return parsed


def require_block(geometry, row, col, plane, block_x, block_y):
    """The block asked for must be there (`bad_request`)."""
    rows, cols = geometry.grids[0]
    blocks = geometry.blocks(plane)
    inside = 0 <= row < rows and 0 <= col < cols and 0 <= block_x < blocks[0] and 0 <= block_y < blocks[1]
    if not inside:
        raise StreamError("bad_request")


def write_views(decoder, folder, with_ppm):
    """Every view is decoded before the first file is written."""
    header = decoder.stream.header
    views = {(r, c): decode_view(decoder, r, c) for r in range(header.rows) for c in range(header.cols)}
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "views.raw", "wb") as raw:
        for (row, col), view in views.items():
            raw.write(raw_bytes(view, header.depth))
            if with_ppm:
                (folder / f"{row:02}_{col:02}.ppm").write_bytes(ppm_bytes(view, header.depth))


def main(arguments):
    """Returns the exit status."""
    options = parse_arguments(arguments)
    try:
        data = options.file.read_bytes()
    except OSError as error:
        print(error, file=sys.stderr)
        return 3
    try:
        decoder = BlockDecoder(Stream(data))
        if options.trace is not None:
            require_block(decoder.stream.geometry, *options.trace)
            for record in trace_block(decoder, *options.trace):
                print(json.dumps(record))
        else:
            write_views(decoder, options.output, options.ppm)
    except StreamError as error:
        print(error.name, file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
