"""The naive decoder against recorded answers of the program under test."""

import random

from block import BlockDecoder
from light_field import decode_view
from opening import Stream
from stream_error import StreamError
from trace import PLANE_NAMES, trace_block


def attempt(action, *arguments):
    """What the action returns, or the name of the error that ends it."""
    try:
        return action(*arguments)
    except StreamError as error:
        return error.name


def naive_view(decoder, row, col):
    """Samples of a view, R, G, B pixel by pixel."""
    return [sample for line in decode_view(decoder, row, col) for pixel in line for sample in pixel]


def random_blocks(stream, count, seed):
    """(row, col, plane, block_x, block_y) of blocks of views."""
    rng, header = random.Random(seed), stream.header
    for _ in range(count):
        plane = rng.randrange(3)
        cols, rows = stream.geometry.blocks(plane)
        view = rng.randrange(header.rows), rng.randrange(header.cols)
        yield *view, plane, rng.randrange(cols), rng.randrange(rows)


def cropped(records, geometry):
    """Records of trace_block without the values outside the plane, which have no meaning (STR-6)."""
    if isinstance(records, str):
        return records
    plane, (block_x, block_y) = PLANE_NAMES.index(records[0]["plane"]), records[0]["block"]
    side = geometry.block
    width, height = geometry.plane_size(plane)
    cols, rows = min(side, width - block_x * side), min(side, height - block_y * side)
    inside = [side * y + x for y in range(rows) for x in range(cols)]
    stages = [{**record, "values": [record["values"][i] for i in inside]} for record in records[1:]]
    return records[:1] + stages


class Answers:
    """What the program under test said of one stream: the error in opening it, or views and some blocks."""

    def __init__(self, golden, data, blocks, seed=0):
        self.data, self.views, self.blocks = data, {}, {}
        stream = attempt(Stream, data)
        if isinstance(stream, str):
            self.error = golden.opens()
            return
        self.views = golden.views(stream.header)
        self.error = next((views for views in self.views.values() if isinstance(views, str)), "ok")
        for place in random_blocks(stream, blocks, seed):
            self.blocks[place] = cropped(golden.stages(*place), stream.geometry)

    def differences(self):
        """What the naive decoder says differently: an empty list if nothing."""
        stream = attempt(Stream, self.data)
        if isinstance(stream, str):
            return [] if stream == self.error else [f"opening: naive {stream}, program {self.error}"]
        decoder = BlockDecoder(stream)
        found = []
        for place, expected in self.blocks.items():
            actual = cropped(attempt(trace_block, decoder, *place), stream.geometry)
            if actual != expected:
                found.append(f"block {place}: naive {actual}, program {expected}")
        for place, expected in self.views.items():
            actual = attempt(naive_view, decoder, *place)
            if actual != expected:
                found.append(f"view {place}: naive {summary(actual)}, program {summary(expected)}")
        return found


def summary(view):
    """A view for a message: its error, or a checksum."""
    return view if isinstance(view, str) else f"samples with sum {sum(view)}"
