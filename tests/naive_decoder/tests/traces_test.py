"""The stages of every block that the suite traces, computed by the naive decoder. The suite's samples and errors
are compared by conform.naive."""

import paths
import json
import unittest
from concurrent.futures import ProcessPoolExecutor
from itertools import groupby

from block import BlockDecoder
from opening import Stream
from program import main
from stream_error import StreamError
from trace import PLANE_NAMES, trace_block

FOLDER = paths.DECODER.parents[1] / "vectors"


def cropped(records, geometry):
    """Records of one block without the values outside the plane, which have no meaning (STR-6)."""
    plane, (block_x, block_y) = PLANE_NAMES.index(records[0]["plane"]), records[0]["block"]
    side = geometry.block
    width, height = geometry.plane_size(plane)
    cols, rows = min(side, width - block_x * side), min(side, height - block_y * side)
    inside = [side * y + x for y in range(rows) for x in range(cols)]
    stages = [{**record, "values": [record["values"][i] for i in inside]} for record in records[1:]]
    return records[:1] + stages


def wrong_blocks(vector):
    """The blocks in the trace of a vector whose stages differ."""
    decoder = BlockDecoder(Stream((FOLDER / vector["input"]["file"]).read_bytes()))
    lines = map(json.loads, (FOLDER / vector["trace"]["file"]).read_text().splitlines())
    wrong, expected = [], []
    for is_block, records in groupby(lines, lambda record: record["record"] == "block"):
        if is_block:
            expected = list(records)[-1:]
            continue
        expected += [record for record in records if record["record"] == "stage"]
        block = expected[0]
        place = (*block["view"], PLANE_NAMES.index(block["plane"]), *block["block"])
        try:
            found = cropped(trace_block(decoder, *place), decoder.stream.geometry)
        except StreamError as error:
            found = error.name
        if found != cropped(expected, decoder.stream.geometry):
            wrong.append(place)
    return wrong


class TracesTest(unittest.TestCase):
    def test_stages_are_those_of_the_suite(self):
        manifest = json.loads((FOLDER / "manifest.json").read_text())
        traced = [vector for vector in manifest["vectors"] if "trace" in vector]
        self.assertGreater(len(traced), 50)
        with ProcessPoolExecutor() as workers:
            for vector, wrong in zip(traced, workers.map(wrong_blocks, traced)):
                self.assertEqual(wrong, [], vector["id"])


if __name__ == "__main__":
    main()
